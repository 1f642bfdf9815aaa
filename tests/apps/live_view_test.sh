#!/bin/bash
# live_view_test.sh WEFT: what can be seen of a render while it goes on.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1

cat >s.xml <<'X'
<integrator type="path" depth="4">
  <sampler type="sobol" count="4"/>
  <scene>
    <camera type="perspective" width="40" height="30" fov="40">
      <transform><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform>
    </camera>
    <light type="envmap"><texture type="constant" value="0.5"/></light>
    <instance><shape type="sphere"/><bsdf type="diffuse" albedo="0.5"/></instance>
  </scene>
</integrator>
X

# A server that takes pictures as tev does: one that is created, and updates of its channels.
cat >server.py <<'P'
import socket, struct, sys, zlib
server = socket.create_server(("127.0.0.1", 0))
open("port", "w").write(str(server.getsockname()[1]))
connection = server.accept()[0]
data = b""
while chunk := connection.recv(1 << 16):
    data += chunk
at, created, updates, pixels = 0, None, [], {}
def text(b):
    return b.split(b"\0", 1)
while at < len(data):
    size, kind = struct.unpack_from("<IB", data, at)
    body, at = data[at + 6:at + size], at + size
    name, body = text(body)
    assert name == b"live.exr", name
    if kind == 4:
        assert created is None
        width, height, channels = struct.unpack_from("<iii", body)
        created = (width, height, body[12:].split(b"\0")[:channels])
        assert created == (40, 30, [b"R", b"G", b"B"]), created
    else:
        assert kind == 3 and created, kind
        channel, body = text(body)
        assert struct.unpack_from("<iiii", body) == (0, 0, 40, 30)
        assert len(body) == 16 + 4 * 40 * 30, len(body)
        pixels[channel] = struct.unpack("<1200f", body[16:])
        updates.append(channel)
assert updates and len(updates) % 3 == 0 and updates[:3] == [b"R", b"G", b"B"], updates
assert all(p > 0.01 for c in pixels.values() for p in c), "the last picture is not whole"
print(len(updates) // 3, "pictures")
P
python3 server.py >server.out 2>&1 &
server=$!
wait_for [ -s port ]
expect 0 "$weft" render s.xml -o live.exr --tev "127.0.0.1:$(cat port)" --time 3s
wait $server || { cat server.out; fail "not what tev expects"; }
expect 2 "$weft" render s.xml -o live.exr --tev "127.0.0.1:$(cat port)" # nobody is there any more
has "nobody listens at" err
expect 2 "$weft" render s.xml -o live.exr --tev "no such host:1"

# A PNG that is there, and whole, before the render is done, and its last state after it.
start_render s.xml -o w.exr --watch w.png
wait_for [ -s w.png ]
"$weft" compare w.png w.png >/dev/null || fail "the picture to watch is not whole"
wait_for_samples
stop_render
[ $code = 130 ] || fail "watching ended the render"
expect 0 "$weft" render s.xml -o last.exr -o last.png --watch w.png
expect 0 "$weft" compare last.png w.png --mae 0
expect 2 "$weft" render s.xml -o w.exr --watch nowhere/w.png

# A picture to watch that can no longer be written takes nothing from the render.
mkdir gone
start_render s.xml -o kept.exr --watch gone/w.png
wait_for [ -s gone/w.png ]
wait_for_samples
rm -r gone
wait_for grep -q 'the picture to watch was not written' err
stop_render # and fails to write it once more
[ $code = 130 ] || fail "a lost picture to watch ended the render"
[ -s kept.exr ] || fail "a lost picture to watch took the picture with it"
[ "$(grep -c 'the picture to watch was not written' err)" = 1 ] || fail "it is not told once"

# A preview is small and quick, unless said otherwise.
expect 0 "$weft" render s.xml -o p.exr --preview
has "20 x 15 pixels, 8 samples each" err
expect 0 "$weft" render s.xml -o p.exr --preview --spp 3 --size 10x10
has "10 x 10 pixels, 3 samples each" err

# JSON with phases, and a profile whose parts are the whole.
expect 0 "$weft" render s.xml -o j.exr --progress json --noise 0.05 --profile
python3 - <<'P' || fail "progress is not as documented"
import json
lines = open("err").read().splitlines()
objects = [json.loads(l) for l in lines if l.startswith("{")]
phases = [o["phase"] for o in objects]
assert phases[:3] == ["read", "commit", "render"], phases
assert phases[-3:] == ["write", "done", "profile"], phases
assert all("percent" in o and "memory" in o for o in objects)
last = [o for o in objects if o["phase"] == "render"][-1]
assert last["percent"] == 100 and 0 < last["noise"] <= 0.05 and last["secondsLeft"] == 0, last
done, profile = objects[-2:]
assert done["complete"] and done["leastSamples"] >= 32 and done["peakMemory"] > 1e6, done
assert set(profile["phases"]) == {"read", "commit", "render", "write"}, profile
assert abs(sum(profile["phases"].values()) - profile["seconds"]) < 0.003, profile # rounding
P

[ $failures = 0 ] && echo "renders can be watched"
