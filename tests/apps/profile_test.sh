#!/bin/bash
# profile_test.sh WEFT: what `weft render --profile` says adds up, is what the scene is made of, and
# changes no pixel.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1
without_dates

# scene FILE MATERIAL LIGHTS: a floor.
scene() {
    cat >"$1" <<X
<integrator type="path" depth="3" aovs="albedo">
  <image id="picture"/>
  <sampler type="sobol" count="64"/>
  <scene>
    <camera type="perspective" id="cam" width="160" height="120" fov="40">
      <transform><lookat origin="0,-4,-4" target="0,0,0" up="0,1,0"/></transform>
    </camera>
    $3
    <instance><shape type="rectangle"/>$2<transform><rotate axis="1,0,0" angle="90"/><scale value="9"/></transform></instance>
    <instance><shape type="sphere"/><bsdf type="roughconductor" roughness="0.4"/></instance>
  </scene>
</integrator>
X
}
plain='<bsdf type="diffuse" albedo="0.5"/>'
lamp='<light type="point" position="2,-3,-4" power="100"/>'
scene plain.xml "$plain" "$lamp"
expect 0 "$weft" render plain.xml -o grain.png --spp 1 --size 64x64
# product NAME DEPTH ID: of 2^DEPTH images, no two of which are the same lookup.
product() {
    if [ "$2" = 0 ]; then
        echo "<texture name=\"$1\" type=\"image\" filename=\"grain.png\" exposure=\"1.$3\"/>"
    else
        echo "<texture name=\"$1\" type=\"multiply\">$(product in1 $(($2 - 1)) "${3}1")$(product in2 $(($2 - 1)) "${3}2")</texture>"
    fi
}
scene textured.xml "<bsdf type=\"diffuse\">$(product albedo 3 "")</bsdf>" "$lamp"
scene lit.xml "$plain" "$(for i in $(seq 1000); do
    echo "<light type=\"point\" position=\"$((i % 37 - 18)).$((i % 7)),-3,$((i % 41 - 20)).$((i % 9))\" power=\"1\"/>"
done)"

# A picture has the same bits.
expect 0 "$weft" render lit.xml -o without.exr --spp 4
expect 0 "$weft" render lit.xml -o with.exr --spp 4 --profile
cmp -s without.exr with.exr || fail "--profile changed the picture"

# As text: percents of each feature, of the whole.
expect 0 "$weft" render plain.xml -o p.exr --profile --threads 2
python3 - <<'P' || fail "the table is not as it should be"
import re
lines = open("err").read().splitlines()
names = [l.split()[0] for l in lines if re.match(r"(read|commit|render|write|total) ", l)]
assert names == ["read", "commit", "render", "write", "total"], names
at = lines.index(next(l for l in lines if l.startswith("render ")))
rows = []
for line in lines[at + 1:]:
    if line.startswith("  all features"):
        break
    rows.append(re.fullmatch(r"  (\D+?) +([\d.]+ s|[\d:]+) +([\d.]+) %", line).groups())
assert abs(sum(float(r[2]) for r in rows) - 100) <= 5, rows
parts = [float(r[2]) for r in rows]
assert parts == sorted(parts, reverse=True), rows
assert {"closest hits", "shadow rays", "bsdf", "film"} <= {r[0] for r in rows}, rows
assert int(re.search(r"by (\d+) samples", line)[1]) > 20, line
P

# For programs, on one thread: the whole is what the system says, the parts add up to it, and are
# greater where a scene has more of their kind.
python3 - "$weft" <<'P' || fail "the features do not add up, or are others than the scene's"
import json, os, subprocess, sys
def render(scene, spp, *options):
    process = subprocess.Popen([sys.argv[1], "render", scene, "-o", "j.exr", "--threads", "1",
                                "--spp", str(spp), "--progress", "json", "--profile", *options],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    error = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    assert status == 0, error
    lines = [json.loads(line) for line in error.splitlines() if line.startswith("{")]
    assert [l["phase"] for l in lines][-2:] == ["done", "profile"], error
    return lines[-1], usage.ru_utime + usage.ru_stime
def parts(profile):
    return {f["name"]: f["percent"] for f in profile["features"]}
_, short_usage = render("plain.xml", 1)
found = {}
for name in "plain", "textured", "lit":
    profile, usage = render(name + ".xml", 128)
    whole = profile["processorSeconds"]
    assert abs(sum(f["seconds"] for f in profile["features"]) / whole - 1) < 0.05, profile
    assert abs(sum(parts(profile).values()) - 100) < 5, profile
    assert set(profile["phases"]) == {"read", "commit", "render", "write"}, profile
    assert sum(profile["phases"].values()) <= profile["seconds"] + 0.01, profile
    assert whole <= profile["threadSeconds"] * 1.01, profile
    assert profile["profileSamples"] > 50, profile
    if name == "plain":
        # What is not rendering takes as long as all of a render of one sample; where other programs
        # take turns on the processors' caches, twice as long at most.
        assert usage - 2 * short_usage <= whole <= usage, (whole, usage, short_usage)
    found[name] = parts(profile)
    print(name, found[name])
assert found["plain"]["textures"] == 0
assert found["textured"]["textures"] > 5
assert found["lit"]["light choice"] > 5
assert found["lit"]["light choice"] > 2 * found["plain"]["light choice"]
P

# Of a render that is stopped, too.
start_render plain.xml -o c.exr --profile
wait_for_samples
stop_render
[ $code = 130 ] || fail "no clean stop"
has '"features":[' err
[ -s c.exr ] || fail "no picture of what was done"
expect 0 "$weft" render plain.xml -o p.exr --spp 1
if grep -q "all features" err; then fail "a profile that nobody asked for"; fi

[ $failures = 0 ] && echo "profiles add up"
exit $((failures > 0))
