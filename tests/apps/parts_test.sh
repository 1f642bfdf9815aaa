#!/bin/bash
# parts_test.sh WEFT: renders that are killed and go on, and renders in parts, have the bits of one
# that was made at once.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1
without_dates

cat >s.xml <<'X'
<integrator type="path" depth="6" aovs="depth, albedo, crypto_object">
  <image id="picture"/>
  <sampler type="sobol" count="24"/>
  <scene>
    <camera type="perspective" id="cam" width="120" height="80" fov="40">
      <transform><lookat origin="0,0,-5" target="0,0,0" up="0,1,0"/></transform>
    </camera>
    <light type="envmap"><texture type="constant" value="0.5"/></light>
    <light type="point" position="2,-3,-4" power="100"/>
    <instance id="ball"><shape type="sphere"/><bsdf type="principled" roughness="0.3"/></instance>
  </scene>
</integrator>
X

# Shards and ranges of samples.
expect 0 "$weft" render s.xml -o whole.exr
for k in 1 2 3; do expect 0 "$weft" render s.xml --shard $k/3 -o p$k.weft; done
expect 0 "$weft" merge p3.weft p1.weft p2.weft -o joined.exr -o joined.png
cmp -s whole.exr joined.exr || fail "three shards are not the whole"
expect 2 "$weft" merge p1.weft p3.weft -o j.exr
has "missing: shard 2/3" err
expect 2 "$weft" merge p1.weft p2.weft p2.weft p3.weft -o j.exr
has "shard 2/3 is there twice: p2.weft and p2.weft" err
expect 0 "$weft" render s.xml --shard 3/3 --seed 4 -o seed.weft
expect 2 "$weft" merge p1.weft p2.weft seed.weft -o j.exr
has "seed.weft is of another render than p1.weft ('here'): seed is '0' here and '4' there" err
expect 0 "$weft" render s.xml --samples 0:10 # where the scene says
[ -s picture.samples-0-10.weft ] || fail "no name for a part"
expect 0 "$weft" render s.xml --samples 10:24 -o b.weft
expect 0 "$weft" merge b.weft picture.samples-0-10.weft -o ranges.exr
expect 0 "$weft" compare whole.exr ranges.exr --mae 1e-7
expect 2 "$weft" merge b.weft -o j.exr
has "missing: samples 0:10" err
head -c 5000 b.weft >cut.weft
expect 2 "$weft" merge cut.weft -o j.exr
has "cut.weft: the file is damaged or cut off" err
[ ! -e j.exr ] || fail "a failed merge left a picture"
for bad in "--shard 4/3" "--shard 2" "--samples 3:3" "--samples 0:25" "--shard 1/2 -o a.exr" \
    "--shard 1/2 --noise 0.1" "--samples 0:2 --time 3s" "--checkpoint never" "--resume" "--time 0s"; do
    # shellcheck disable=SC2086 # words are options
    expect 2 "$weft" render s.xml $bad
done

# Killed at several moments, by a signal that nobody can catch.
common=(s.xml --spp 600 --threads 2 --progress none)
expect 0 "$weft" render "${common[@]}" -o long.exr
python3 - "$weft" "${common[@]}" <<'P' || fail "a killed render did not go on as it should"
import os, random, resource, signal, subprocess, sys, time
weft, common = sys.argv[1], sys.argv[2:]
random.seed(1)
command = [weft, "render", *common, "-o", "killed.exr", "--checkpoint", "0.05s"]
file = "killed.exr.checkpoint"
def written():
    return os.path.exists(file) and os.stat(file).st_mtime_ns
# The system kills the first ones after some processor time, if nobody else does before: so some are
# killed, however late this program gets its turn.
def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (3, 3))
kills, resumed, found = 0, 0, 0
while True:
    before, to_kill = written(), kills < 8
    found += before is not False
    p = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                         preexec_fn=limit if kills < 2 else None)
    if to_kill: # after a checkpoint, at whatever moment
        while p.poll() is None and written() == before:
            time.sleep(0.001)
        time.sleep(random.choice([0, 0.01, 0.05, 0.1, 0.2]))
        p.kill()
    error = p.communicate()[1]
    resumed += "going on from " + file in error
    if p.returncode == 0:
        break
    assert p.returncode == -signal.SIGKILL and to_kill, error
    kills += 1
print(kills, "kills,", resumed, "times gone on")
assert resumed == found >= 1, (resumed, found)
assert not os.path.exists(file), "the checkpoint outlived the render"
P
cmp -s long.exr killed.exr || fail "a killed render has other bits"

# Ctrl-C keeps a checkpoint; another render does not take it, nor write over it.
start_render s.xml -o c.exr --checkpoint 60s
wait_for_samples
stop_render
[ $code = 130 ] || fail "no clean stop"
[ -s c.exr.checkpoint ] || fail "no checkpoint of a render that was stopped"
cp c.exr.checkpoint copy
expect 2 "$weft" render s.xml --spp 10000000 -o c.exr --checkpoint 60s --seed 7
has "seed is '7' here and '0' there" err
expect 2 "$weft" render s.xml --spp 10000000 -o c.exr --resume --set cam.fov=41
has "scene is" err
expect 2 "$weft" render s.xml --spp 20 -o c.exr --resume --aov uv
has "samples per pixel is '20' here and '10000000' there; channels is" err
expect 2 "$weft" render s.xml --spp 10000000 --shard 1/2 --checkpoint-file c.exr.checkpoint -o a.weft
has "it is shard 1/2 here and the whole picture there" err
cmp -s copy c.exr.checkpoint || fail "a refused checkpoint was changed"
printf x | dd of=c.exr.checkpoint bs=1 seek=900 conv=notrunc 2>/dev/null
expect 2 "$weft" render s.xml --spp 10000000 -o c.exr --resume
has "damaged" err
expect 0 "$weft" render s.xml --spp 2 -o c.exr --checkpoint 60s --restart
[ ! -e c.exr.checkpoint ] || fail "a finished render kept its checkpoint"

# A disk that is full, or a folder that takes no files: known before the render starts.
expect 2 "$weft" render s.xml -o f.exr --checkpoint-file /proc/weft.checkpoint
has "cannot make a file in its folder" err
[ ! -e f.exr ] || fail "it rendered all the same"
for other in f.exr ./s.xml watched.png; do
    expect 2 "$weft" render s.xml -o f.exr --watch watched.png --checkpoint-file $other
    has "--checkpoint-file expects a file of its own" err
done
cp copy f.exr.checkpoint
expect 2 bash -c "trap '' XFSZ; ulimit -f 100; $weft render s.xml --spp 10000000 -o f.exr --resume"
has "no room for a second file" err
cmp -s copy f.exr.checkpoint || fail "a full disk took the old checkpoint"
expect 2 bash -c "trap '' XFSZ; ulimit -f 100; $weft render s.xml -o g.exr --checkpoint 60s"
[ ! -e g.exr ] && [ ! -e g.exr.checkpoint ] || fail "it rendered all the same"

# Of several outputs one that finds no room takes the others not with it.
expect 2 bash -c "trap '' XFSZ; ulimit -f 50; $weft render s.xml -o large.exr -o small.png"
has "large.exr: cannot write" err
[ ! -e large.exr ] && [ -s small.png ] || fail "a full disk took the small picture, too"

# Postprocesses want the whole picture: a part of a scene that has some is made without them.
mkdir post
{
    sed 's/ aovs="[^"]*"//' s.xml
    echo '<postprocess type="denoising" backend="nlm"><ref name="input" id="picture"/><image id="clean"/></postprocess>'
} >post/p.xml
expect 0 "$weft" render post/p.xml --shard 1/2
has "postprocesses need the whole picture" err
[ -e post/picture.shard-1-of-2.weft ] || fail "no part was made"
[ ! -e post/clean.exr ] || fail "a part was denoised"

# Noise and time, and what the picture says of them.
expect 0 "$weft" render s.xml -o n.exr --noise 0.1
has "the noise is at most 0.0" err
expect 0 "$weft" render s.xml -o n1.exr --noise 0.1 --threads 1 --tile 7
cmp -s n.exr n1.exr || fail "adaptive sampling depends on threads or tiles"
grep -qa "weft:stoppedBy" n.exr || fail "the picture does not say why it ended"
expect 0 "$weft" render s.xml -o n.exr --noise 0.0001 --spp 40
has "some pixels have all of the 40 samples" err
expect 0 "$weft" render s.xml -o t.exr --time 2s
has "the time was up" err

[ $failures = 0 ] && echo "parts are as good as the whole"
