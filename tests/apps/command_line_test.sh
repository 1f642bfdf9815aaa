#!/bin/bash
# command_line_test.sh WEFT: exit codes, options and outputs of the program.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1

cat >s.xml <<'X'
<integrator type="path" depth="4">
  <image id="picture"/>
  <sampler type="sobol" count="4"/>
  <scene>
    <camera type="perspective" id="cam" width="40" height="30" fov="40">
      <transform><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform>
    </camera>
    <light type="envmap"><texture type="constant" value="0.5"/></light>
    <light type="point" position="2,-3,-4" power="100"/>
    <instance><shape type="sphere"/><bsdf type="diffuse" albedo="0.5"/></instance>
  </scene>
</integrator>
X

# Materials that are legal and hardly meant.
sed 's|<bsdf type="diffuse" albedo="0.5"/>|<bsdf type="layered"><layer opacity="0.4">\
<bsdf type="microfacet" ior="1.3" reflectionIor="2"/></layer></bsdf>|' s.xml >odd.xml
expect 0 "$weft" info odd.xml
has "odd.xml:11:1: reflectionIor 2 and ior 1.3 would give out up to" out
has "odd.xml:10:37: the last <layer> has opacity 0.4: what it does not cover is black" out
sed 's|reflectionIor="2"|reflectionIor="1.31"|; s|opacity="0.4"|opacity="1"|' odd.xml >even.xml
expect 0 "$weft" info even.xml
if grep -q warning out; then fail "a warning about even.xml"; fi

# Outputs: beside the scene, where -o says, several, in a folder.
expect 0 "$weft" render s.xml
[ -s picture.exr ] || fail "picture.exr is not beside the scene"
mkdir folder
expect 0 "$weft" render s.xml -o a.exr -o a.png -o folder --progress none
[ -s a.exr ] && [ -s a.png ] && [ -s folder/picture.exr ] || fail "an output is missing"

# Same bits whatever the threads and tiles; a crop is a part of the whole.
expect 0 "$weft" render s.xml -o b.exr --threads 1 --tile 7
expect 0 "$weft" compare a.exr b.exr --mae 0
expect 0 "$weft" render s.xml -o c.exr --seed 1
expect 1 "$weft" compare a.exr c.exr --mae 0
expect 0 "$weft" compare a.exr c.exr --diff d.png
[ -s d.png ] || fail "no difference picture"
has relMSE out
expect 0 "$weft" render s.xml -o crop.exr --crop 10,5,30,25
expect 2 "$weft" compare a.exr crop.exr
expect 2 "$weft" render s.xml -o crop.exr --crop 10,5,90,25
expect 0 "$weft" render s.xml -o small.exr --size 50%
expect 2 "$weft" render s.xml -o small.exr --size 0x3

# AOVs go into the EXR file, which says how it was made; a PNG takes beauty alone.
expect 0 "$weft" render s.xml -o layers.exr -o layers.png --aov albedo,depth --aov crypto_object
expect 0 "$weft" render s.xml -o plain.exr
if cmp -s layers.exr plain.exr; then fail "no layers were written"; fi
for word in albedo.R CryptoObject02.A cryptomatte/3ae39a5/manifest weft:sceneHash \
    weft:renderSeconds weft:camera chromaticities; do
    grep -aq "$word" layers.exr || fail "layers.exr has no $word"
done
expect 0 "$weft" compare layers.png layers.png
expect 0 "$weft" render s.xml -o layers.EXR --aov albedo
grep -aq albedo.R layers.EXR || fail "layers.EXR has no albedo"
expect 0 env SOURCE_DATE_EPOCH=0 "$weft" render s.xml -o same1.exr --threads 1
expect 0 env SOURCE_DATE_EPOCH=0 "$weft" render s.xml -o same2.exr --tile 7
cmp -s same1.exr same2.exr || fail "equal input gave other bytes"
expect 2 "$weft" render s.xml -o layers.exr --aov albido
has "did you mean 'albedo'?" err
expect 2 "$weft" render s.xml -o layers.png --aov albedo
has "expects an output that can hold further channels" err
expect 0 "$weft" render --aov list
has "CryptoObject00.R" out
expect 0 "$weft" help aov
has "denoise_albedo" out
expect 2 "$weft" render
expect 0 "$weft" render s.xml -o layers.exr --set integrator.aovs=uv,normal
grep -aq UV.U layers.exr || fail "the scene's AOVs are not written"

# One path again.
expect 0 "$weft" replay s.xml --pixel 20,15 --sample 1 --seed 2
has "camera at" out
cat >sky.xml <<'XML'
<integrator type="path" depth="4"><sampler type="sobol" count="1"/><image id="sky"/><scene>
  <camera type="perspective" width="8" height="8"><transform><translate z="-4"/></transform></camera>
  <light type="sky" elevation="40"/>
  <instance><shape type="sphere"/><bsdf type="disney" baseColor="0.6,0.3,0.2" roughness="0.3"/></instance>
</scene></integrator>
XML
expect 0 "$weft" render sky.xml --crop 4,4,5,5 -o sky.exr
expect 0 "$weft" replay sky.xml --pixel 4,4
python3 -c 'import re, subprocess
told = [float(x) for x in re.search(r"^= (.*)$", open("out").read(), re.M)[1].split()]
stats = subprocess.run(["oiiotool", "sky.exr", "--printstats"], capture_output=True, text=True).stdout
seen = [float(x) for x in re.search(r"Stats Avg: ([^(]*)", stats)[1].split()]
assert all(abs(a - b) < 1e-4 * b for a, b in zip(told, seen)), (told, seen)' || fail "replay traced another path"
expect 2 "$weft" replay s.xml --pixel 2000,15
has "expects a pixel inside of the picture" err
expect 2 "$weft" replay s.xml --pixel 1.5,2
expect 2 "$weft" replay s.xml

# --set, by tag and by id.
expect 0 "$weft" render s.xml -o e.exr --set camera.fov=20 --set cam.width=41
expect 2 "$weft" render s.xml -o f.exr --set camera.fow=20
has "did you mean 'fov'?" err
expect 2 "$weft" render s.xml -o f.exr --set kamera.fov=20
[ ! -e f.exr ] || fail "a failed render left a picture"

# Progress as JSON, one object a line.
expect 0 "$weft" render s.xml -o g.exr --progress json
python3 -c 'import json
lines = [json.loads(l) for l in open("err") if l.startswith("{")]
assert lines and lines[-1]["percent"] == 100, lines' || fail "progress is not JSON"

# Mistakes.
expect 2 "$weft" render missing.xml
expect 2 "$weft" render s.xml -o nowhere/a.exr
expect 2 "$weft" render s.xml -o a.tga
expect 2 "$weft" render s.xml --sppp 3
expect 2 "$weft" render s.xml --noise nan
expect 2 "$weft" compare a.exr b.exr --mae -1
has "--mae: expects a number of at least 0, found '-1'" err
expect 2 "$weft" compare a.exr b.exr --flip nan
expect 2 "$weft" render s.xml -o "$(printf 'a%.0s' {1..300})/b.exr"
has "File name too long" err
expect 2 "$weft" docs /proc/pages
expect 2 "$weft"
sed 's/diffuse/difuse/' s.xml >bad.xml
cp a.exr old.exr
expect 2 "$weft" render bad.xml -o old.exr
has "did you mean 'diffuse'?" err
cmp -s a.exr old.exr || fail "the old picture was changed"

# Help and schema.
expect 0 "$weft" --help
expect 0 "$weft" render --help
expect 0 "$weft" help
expect 0 "$weft" help thinlens
has lensRadius out
expect 2 "$weft" help thinlense
has "did you mean 'thinlens'?" err
expect 0 "$weft" schema --json
python3 -c 'import json; assert len(json.load(open("out"))["types"]) > 30' || fail "the schema is not JSON"
mkdir -p pages/camera.md # a page that cannot be written, though the last one can
expect 2 "$weft" docs pages
has "pages/camera.md" err
expect 0 "$weft" info s.xml
has "objects" out

# Tests with a reference.
sed -e 's/<integrator /<test type="image" id="t" mae="1e-6" me="1e-6"><integrator /' -e 's/<.integrator>/&<\/test>/' s.xml >t.xml
cp a.exr t_ref.exr
expect 0 "$weft" test t.xml
has "1 passed, 0 failed" out
cp c.exr t_ref.exr
expect 1 "$weft" test t.xml
has "0 passed, 1 failed" out
rm t_ref.exr
expect 2 "$weft" test t.xml

# Ctrl-C: a clean stop that keeps what is done.
start_render s.xml -o long.exr
wait_for_samples
stop_render
[ $code = 130 ] || fail "expected exit code 130 after an interrupt, found $code"
has "what is done is written" err
grep -qE '[1-9][0-9]* of 10000000 samples in each pixel' err || fail "not how many samples it has"
[ -s long.exr ] || fail "an interrupted render wrote nothing"

# Progress in plain lines, where stderr is no terminal.
"$weft" render s.xml --spp 10000000 -o lines.exr >out 2>err &
pid=$!
wait_for grep -q '% after' err
stop_render

# Ctrl-C before every pixel has a sample leaves an older picture as it is, whenever it comes; and
# the second one kills at once. Many lights make the first sample of all pixels take minutes.
{
    sed -e '/<light type="point"/,$d' -e 's/<integrator /&lightSamples="1024" /' \
        -e 's/width="40" height="30"/width="2000" height="2000"/' s.xml
    for i in $(seq 300); do
        echo "<light type=\"point\" position=\"$((i % 17 - 8)),-9,$((i / 17 - 9))\" power=\"9\"/>"
    done
    sed -n '/<instance>/,$p' s.xml
} >big.xml
cp a.exr old.exr
python3 - "$weft" <<'P' || fail "an interrupt was not answered"
import os, signal, subprocess, sys, time

def start():
    return subprocess.Popen([sys.argv[1], "render", "big.xml", "-o", "old.exr", "--threads", "1",
                             "--progress", "json"],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

def processor_seconds(pid): # user and system, behind the program's name in parentheses
    fields = open(f"/proc/{pid}/stat").read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

def interrupt(p, heard="", times=1):
    before = processor_seconds(p.pid)
    for _ in range(times):
        p.send_signal(signal.SIGINT)
    message = heard + p.stderr.read()
    _, status, usage = os.wait4(p.pid, 0)
    p.returncode = os.waitstatus_to_exitcode(status)
    return p.returncode, message, usage.ru_utime + usage.ru_stime - before

# At whatever moment, and at the beginning of each phase.
for delay in (0, 0.01, 0.02, 0.05, 0.1, 0.2):
    p = start()
    time.sleep(delay)
    code, message, seconds = interrupt(p)
    # Before main begins the system answers, without a word.
    assert code == 130 and "no file is overwritten" in message or code == -signal.SIGINT, \
        (delay, code, message)
for phase in '"phase":"read"', '"phase":"commit"', '"phase":"render"', '"samples":0':
    p, heard = start(), ""
    while phase not in heard:
        line = p.stderr.readline()
        assert line, (phase, heard)
        heard += line
    code, message, seconds = interrupt(p, heard)
    assert code == 130 and "no file is overwritten" in message, (phase, code, message)
    # Sampling ends at once; the film of so many pixels is looked through and freed.
    assert seconds < 3, (phase, seconds)
code, message, seconds = interrupt(start(), times=2)
assert code in (130, -signal.SIGINT), (code, message)
P
cmp -s a.exr old.exr || fail "an interrupted render overwrote the old picture"

[ $failures = 0 ] && echo "the command line works"
exit $((failures > 0))
