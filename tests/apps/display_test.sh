#!/bin/bash
# display_test.sh WEFT SOURCE: how pictures are shown and bloomed, by scene files and options.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1
without_dates
unset OCIO

cat >plain.xml <<'X'
<integrator type="path" depth="3"><sampler type="sobol" count="4"/><image id="plain"/>
  <scene><camera type="perspective" width="60" height="40"/>
    <light type="envmap"><texture type="constant" value="0.3,0.4,0.5"/></light>
    <instance><shape type="sphere"/><emission type="lambertian" emission="9,4,1"/>
      <transform><scale value="0.2"/><translate z="2"/></transform></instance></scene></integrator>
X
sed 's|<image id="plain"/>|<image id="plain"><display exposure="-1" view="agx"/></image>|' plain.xml >shown.xml
expect 0 "$weft" render plain.xml -o plain.exr -o plain.png --progress none
expect 0 "$weft" render shown.xml -o shown.exr -o shown.png -o shown.jpg -o shown.tif --progress none

# The light is the same, the picture is not; options of the same names go first.
cmp -s plain.exr shown.exr || fail "a display changed an EXR file"
expect 1 "$weft" compare plain.png shown.png --mae 0.01
expect 0 "$weft" render shown.xml -o a.png --progress none --exposure 0 --view standard
expect 0 "$weft" compare a.png plain.png --mae 0
expect 0 "$weft" render plain.xml -o a.png --progress none --exposure -1 --view agx
expect 0 "$weft" compare a.png shown.png --mae 0
expect 0 "$weft" render shown.xml -o a.png --progress none --set display.view=aces
expect 1 "$weft" compare a.png shown.png --mae 0.01

# A picture that is there already.
expect 0 "$weft" display plain.exr -o a.png
expect 0 "$weft" compare a.png plain.png --mae 0
expect 0 "$weft" display plain.exr -o a.png -o a.tif --exposure -1 --view agx
expect 0 "$weft" compare a.png shown.png --mae 0
expect 0 "$weft" compare a.tif shown.tif --mae 0
expect 0 "$weft" display plain.png -o a.png
expect 0 "$weft" compare a.png plain.png --mae 1e-6
expect 0 "$weft" display plain.exr -o a.png --neutral 0.3,0.4,0.5
expect 0 "$weft" display --list-views
has agx out

# Mistakes, at their places.
sed 's|view="agx"|view="agxx"|' shown.xml >bad.xml
expect 2 "$weft" render bad.xml -o bad.png
has "bad.xml:1:86: no view is called 'agxx' (did you mean 'agx'?)" err
[ ! -e bad.png ] || fail "a picture in spite of a mistake"
sed 's|view="agx"|veiw="agx"|' shown.xml >bad.xml
expect 2 "$weft" render bad.xml -o bad.png
has "did you mean 'view'?" err
expect 2 "$weft" display plain.exr -o a.png --exposure bright
has "--exposure expects a number" err
expect 2 "$weft" display plain.exr -o a.png --temperature 700
has "at least 1500" err
expect 2 "$weft" display plain.exr -o a.png --ocio nothing.ocio
has "nothing.ocio: expected an OpenColorIO configuration" err
expect 2 "$weft" display plain.exr
has "expected -o OUT" err
expect 2 "$weft" display missing.exr -o a.png

# Bloom in a scene file and by itself.
sed 's|$||; $a <postprocess type="bloom" strength="0.3" fov="60"><ref name="input" id="plain"/><image id="bloomed"/></postprocess>' plain.xml >bloom.xml
mkdir out_folder
expect 0 "$weft" render bloom.xml -o out_folder --progress none
cmp -s plain.exr out_folder/plain.exr || fail "bloom changed the picture that it reads"
expect 0 "$weft" bloom plain.exr -o a.exr --strength 0.3 --fov 60
expect 0 "$weft" compare a.exr out_folder/bloomed.exr --mae 0
expect 0 "$weft" compare a.exr plain.exr --me 1e-4
expect 1 "$weft" compare a.exr plain.exr --mae 0.001
# What a command does not work on arrives as it was, and a comparison sees all of it.
expect 0 "$weft" render plain.xml -o crop.exr --crop 4,2,20,14 --aov alpha,depth,crypto_object --progress none
expect 0 "$weft" bloom crop.exr -o bloomed.exr --strength 0.3
for what in "pixel data origin: x=4, y=2" "full/display size" "chromaticities" "cryptomatte/"; do
    [ "$(iinfo -v crop.exr | grep -F "$what")" = "$(iinfo -v bloomed.exr | grep -F "$what")" ] ||
        fail "a bloom changed '$what'"
done
# So it is with postprocesses of a scene, one after the other.
sed 's|depth=|aovs="alpha,depth,crypto_object" depth=|' bloom.xml >kept.xml
grep -q aovs kept.xml || fail "the scene has no AOVs"
echo '<postprocess type="denoising" backend="nlm"><ref name="input" id="bloomed"/><image id="kept"/></postprocess>' >>kept.xml
expect 0 "$weft" render kept.xml -o kept.exr --crop 4,2,20,14 --progress none
grep -q AOVs err && fail "AOVs are not written"
for what in "pixel data origin: x=4, y=2" "full/display size" "chromaticities" "cryptomatte/"; do
    [ "$(iinfo -v crop.exr | grep -F "$what")" = "$(iinfo -v kept.exr | grep -F "$what")" ] ||
        fail "a postprocess changed '$what'"
done
expect 0 "$weft" compare kept.exr crop.exr
has "the same: A, " out
has "bloom (glare), denoising (nlm)" <(iinfo -v kept.exr)
expect 0 "$weft" render kept.xml -o kept.png --crop 4,2,20,14 --progress none
has "AOVs that the scene asks for are not written" err
# A file that a postprocess reads keeps its windows and channels, too.
echo '<postprocess type="bloom"><image name="input" filename="crop.exr"/><image id="again"/></postprocess>' >file.xml
expect 0 "$weft" render file.xml -o again.exr
expect 0 "$weft" compare again.exr crop.exr
has "the same: A, " out
has "pixel data origin: x=4, y=2" <(iinfo -v again.exr)
expect 0 "$weft" compare bloomed.exr crop.exr
has "the same: A, " out
oiiotool plain.exr --ch R,G,B,A=1 -o alpha.exr
expect 1 "$weft" compare plain.exr alpha.exr
has "A: the picture lacks it" out
oiiotool plain.exr --ch R,G,B,A=0.5 -o clear.exr && oiiotool plain.exr --ch R,G,B,A=1 -o opaque.exr
expect 1 "$weft" compare clear.exr opaque.exr --mse 1e-6
expect 0 "$weft" compare clear.exr opaque.exr --mse 1e-6 --channels RGB
# Parts of a file are layers: the picture is found by its name, and all others arrive.
expect 0 "$weft" bloom plain.exr -o a.exr --strength 0.3
oiiotool plain.exr --attrib oiio:subimagename albedo a.exr --attrib oiio:subimagename rgba \
    plain.exr --attrib oiio:subimagename N --siappendall -o parts.exr
expect 0 "$weft" bloom parts.exr -o more.exr --strength 0.3
expect 1 "$weft" compare more.exr parts.exr --mae 0
has "albedo.R, albedo.G, albedo.B" out
expect 0 "$weft" display parts.exr -o a.png --layer albedo
expect 0 "$weft" display plain.exr -o b.png
cmp -s a.png b.png || fail "the layer looks otherwise than the picture that it is"
expect 2 "$weft" display parts.exr -o a.png --layer albeda
has "did you mean 'albedo'" err
expect 1 "$weft" compare plain.exr parts.exr
has "the picture lacks it" out
expect 2 "$weft" bloom plain.exr -o a.exr --kind glare --sigma 3
has "--sigma" err
expect 2 "$weft" bloom plain.png -o a.exr
has "screen colours" err

[ $failures = 0 ] && echo "display and bloom work"
exit $((failures > 0))
