#!/bin/bash
# image_tests_test.sh WEFT SOURCE: `weft test` over postprocesses, over a file without integrators, and
# after a test without a reference.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
without_dates
cd "$work"

cat >tone.xml <<'END'
<test type="image" id="mapped">
  <postprocess type="tonemap" operator="reinhard">
    <image name="input" filename="light.exr"/>
    <image id="unused"/>
  </postprocess>
</test>
END
cat >light.xml <<'END'
<integrator type="direct">
  <scene><camera type="perspective" width="8" height="8"/>
    <light type="envmap"><texture type="constant" value="3,1,0.25"/></light></scene>
  <sampler type="independent" count="1"/><image id="light"/>
</integrator>
END
cat >mapped_ref.xml <<'END'
<integrator type="direct">
  <scene><camera type="perspective" width="8" height="8"/>
    <light type="envmap"><texture type="constant" value="0.75,0.5,0.2"/></light></scene>
  <sampler type="independent" count="1"/><image id="mapped_ref"/>
</integrator>
END
expect 0 "$weft" render light.xml
expect 2 "$weft" test tone.xml
has "mapped_ref.exr" err
expect 0 "$weft" render mapped_ref.xml
expect 0 "$weft" test tone.xml
has "1 passed, 0 failed" out
[ -e mapped_test.exr ] || fail "no picture of the test"
[ -e unused.exr ] && fail "a test writes its picture only"
expect 0 "$weft" render tone.xml
expect 0 "$weft" compare unused.exr mapped_ref.exr --mae 1e-6
sed 's/ id="mapped"/ id="mapped" allowNegative="false" mae="1e-9" me="1e-9"/; s/reinhard/drago/' tone.xml >strict.xml
expect 1 "$weft" test strict.xml
{
    sed 's/id="mapped"/id="lost"/; s/"unused"/"other"/' tone.xml
    cat tone.xml
} >two.xml
expect 2 "$weft" test two.xml
has "lost_ref.exr" err
has "pass  mapped" out
has "1 passed, 1 failed" out
sed 's|<integrator type="direct">|<test type="image" id="TEST"><integrator type="direct">|; s|</integrator>|</integrator></test>|' light.xml >render.xml
{
    sed 's/TEST/missing/' render.xml
    sed 's/TEST/light/; s/"light"/"light2"/2' render.xml
} >renders.xml
cp light.exr light_ref.exr
expect 2 "$weft" test renders.xml
has "missing_ref.exr" err
has "1 passed, 1 failed" out

exit $((failures > 0))
