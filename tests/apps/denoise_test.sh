#!/bin/bash
# denoise_test.sh WEFT: weft denoise, and postprocesses of scene files.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1
without_dates

cat >s.xml <<'X'
<scene id="room">
  <camera type="perspective" width="64" height="48" fov="40">
    <transform><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform>
  </camera>
  <light type="envmap"><texture type="constant" value="0.5"/></light>
  <instance><shape type="sphere"/><bsdf type="diffuse" albedo="0.5"/></instance>
</scene>
<integrator type="path"><ref id="room"/><sampler type="sobol" count="4"/><image id="noisy"/></integrator>
<integrator type="albedo"><ref id="room"/><sampler type="sobol" count="4"/><image id="albedo"/></integrator>
<integrator type="normal"><ref id="room"/><sampler type="sobol" count="4"/><image id="normal"/></integrator>
<postprocess type="denoising" backend="nlm">
  <ref name="input" id="noisy"/><ref name="albedo" id="albedo"/><ref name="normal" id="normal"/>
  <image id="clean"/>
</postprocess>
X

# Pictures are made in the order of the file, beside it or in a folder.
expect 0 "$weft" render s.xml --progress none
for name in noisy albedo normal clean; do
    [ -s $name.exr ] || fail "$name.exr is not beside the scene"
done
[ "$(tail -n 1 out)" = clean.exr ] || fail "clean.exr is not the last"
mkdir folder
expect 0 "$weft" render s.xml -o folder --progress none
cmp -s clean.exr folder/clean.exr || fail "clean.exr is not the same again"

# A file gets the one picture that nothing reads any further, and the others go nowhere.
mkdir alone
expect 0 "$weft" render s.xml -o alone/one.exr --progress none
cmp -s clean.exr alone/one.exr || fail "one.exr is not the last picture"
[ "$(ls alone)" = one.exr ] || fail "more than the last picture is written: $(ls alone)"
expect 0 "$weft" render s.xml -o alone/one.png -o folder --progress none
[ -s alone/one.png ] || fail "one.png is missing"
expect 2 "$weft" render s.xml -o alone/one.png --aov depth
has "can hold further channels (.exr), found 'alone/one.png'" err
sed '/<postprocess/,$d' s.xml >several.xml
expect 2 "$weft" render several.xml -o one.exr
has "-o expects an existing folder, since the scene renders several pictures ('noisy', 'albedo', 'normal'); found 'one.exr'" err

# Pictures of postprocesses are tests where they have a reference.
mkdir tests
cp s.xml tests
expect 2 "$weft" test tests/s.xml
has "expected a <test> or tests/clean_ref.exr, found none" err
cp clean.exr tests/clean_ref.exr
expect 0 "$weft" test tests/s.xml
has "1 passed, 0 failed" out
[ -s tests/clean_test.exr ] || fail "clean_test.exr is missing"
cp normal.exr tests/clean_ref.exr
expect 1 "$weft" test tests/s.xml
has "0 passed, 1 failed" out

# The command does the same to the files.
expect 0 "$weft" denoise noisy.exr --albedo albedo.exr --normal normal.exr --backend nlm -o again.exr
has "denoised by nlm, with albedo, with normals" err
expect 0 "$weft" compare again.exr clean.exr --mae 1e-6
expect 1 "$weft" compare again.exr noisy.exr --mae 0
expect 0 "$weft" denoise noisy.exr --backend nlm -o plain.png
[ -s plain.png ] || fail "plain.png is missing"
expect 0 "$weft" denoise plain.png --backend nlm -o again.png # screen colours remain such
expect 0 "$weft" compare again.png plain.png --me 0.01

# What is wrong is told before anything is written.
rm -f x.exr
expect 2 "$weft" denoise none.exr -o x.exr
has "none.exr: " err
expect 2 "$weft" denoise noisy.exr --albedo albdo.exr -o x.exr
has "noisy.exr: expected a file or a layer 'albdo.exr' of three channels, found no layers" err
expect 0 "$weft" render s.xml --size 32x24 -o folder --progress none
expect 2 "$weft" denoise noisy.exr --albedo folder/albedo.exr -o x.exr
has "folder/albedo.exr: the albedo expects the size of the picture, 64 x 48, found 32 x 24" err
expect 2 "$weft" denoise noisy.exr --backend optix -o x.exr
expect 2 "$weft" denoise noisy.exr --memory 12 -o x.exr
expect 2 env WEFT_WEIGHTS=/none XDG_DATA_HOME=/none "$weft" denoise noisy.exr --backend network -o x.exr
has "tools/setup denoise" err
expect 2 "$weft" denoise noisy.exr -o missing/x.exr
[ ! -e x.exr ] || fail "something was written"

# Layers of an EXR: guides by their names, parts that sum to the picture, all else as it was.
if command -v oiiotool >/dev/null; then
    oiiotool noisy.exr --mulc 0.25 --chnames l_key.R,l_key.G,l_key.B -o key.exr
    oiiotool noisy.exr --mulc 0.75 --chnames l_fill.R,l_fill.G,l_fill.B -o fill.exr
    oiiotool noisy.exr albedo.exr --chnames albedo.R,albedo.G,albedo.B --chappend \
        normal.exr --chnames N.X,N.Y,N.Z --chappend key.exr --chappend fill.exr --chappend \
        --attrib Owner me -d half -d R=float -d G=float -d B=float -o layers.exr
    expect 0 "$weft" denoise layers.exr --parts 'l_*' --backend nlm -o done.exr
    has "with albedo, with normals" err
    oiiotool --info -v layers.exr | sed '1,2d; /DateTime\|oftware\|History/d' >before
    oiiotool --info -v done.exr | sed '1,2d; /DateTime\|oftware\|History\|postprocess/d' >after
    cmp -s before after || fail "the header changed: $(diff before after)"
    oiiotool done.exr --ch l_key.R,l_key.G,l_key.B --chnames R,G,B -o key.exr
    oiiotool done.exr --ch l_fill.R,l_fill.G,l_fill.B --chnames R,G,B key.exr --add -o sum.exr
    oiiotool done.exr --ch R,G,B -o whole.exr
    expect 0 "$weft" compare sum.exr whole.exr --mae 2e-4
    oiiotool done.exr --ch N.X,N.Y,N.Z -o normals_after.exr
    oiiotool layers.exr --ch N.X,N.Y,N.Z -o normals_before.exr
    expect 0 "$weft" compare normals_after.exr normals_before.exr --mae 0
    expect 0 "$weft" denoise layers.exr --parts l_key,l_fill --backend nlm -o same.exr
    expect 0 "$weft" compare same.exr done.exr --mae 0
    expect 0 "$weft" denoise layers.exr --parts 'l_*' --keep l_key --backend nlm -o kept.exr
    oiiotool kept.exr --ch l_fill.R,l_fill.G,l_fill.B --chnames R,G,B -o fill.exr
    oiiotool kept.exr --ch l_key.R,l_key.G,l_key.B --chnames R,G,B fill.exr --add -o sum.exr
    oiiotool kept.exr --ch R,G,B -o whole.exr
    expect 0 "$weft" compare sum.exr whole.exr --mae 2e-4
    expect 1 "$weft" compare kept.exr done.exr --mae 0

    # What the renderer says has no noise stays as it is, by itself.
    oiiotool noisy.exr key.exr --chnames denoise_kept.R,denoise_kept.G,denoise_kept.B --chappend -o marked.exr
    expect 0 "$weft" denoise marked.exr --backend nlm -o kept.exr
    has "without light in view" err
    expect 0 "$weft" denoise marked.exr --keep denoise_kept --backend nlm -o same.exr
    expect 0 "$weft" compare kept.exr same.exr --mae 0
    expect 0 "$weft" denoise marked.exr --keep none --backend nlm -o same.exr
    grep -q "without light in view" err && fail "--keep none keeps something"
    expect 1 "$weft" compare kept.exr same.exr --mae 0
    expect 2 "$weft" denoise layers.exr --keep l_kye -o x.exr
    has "layers.exr: expected a layer 'l_kye' of three channels (did you mean 'l_key'?)" err
    expect 2 "$weft" denoise layers.exr --parts l_key -o x.exr
    has "expected layers that sum to the picture, found l_key whose sum is off by 75%" err
    expect 2 "$weft" denoise layers.exr --albedo albdo -o x.exr
    has "layers.exr: expected a file or a layer 'albdo' of three channels (did you mean 'albedo'?)" err
    oiiotool albedo.exr --ch R -o grey.exr
    expect 2 "$weft" denoise grey.exr -o x.exr
    has "grey.exr: expected the channels R, G and B, found R" err
fi

[ $failures = 0 ] && echo "denoising works"
exit $((failures > 0))
