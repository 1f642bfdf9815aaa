#!/bin/bash
# textures_test.sh WEFT SOURCE [FILES SIZE MEMORY]: a scene with 400 MB of textures in 50 MB of
# memory: it renders within the cap, and neither cap nor threads change a bit; maketx and the folder
# of converted textures. FILES images of SIZE x SIZE pixels and MEMORY megabytes may be given for a
# larger run by hand: `textures_test.sh build/release/weft . 20 8192 512`.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
files=${3:-4} size=${4:-5800} memory=${5:-50}
cd "$work" || exit 1
export XDG_CACHE_HOME=$work/cache
# peak COMMAND...: its largest resident set in megabytes, in the variable `peak`.
peak() {
    peak=$(python3 -c 'import resource, subprocess, sys
subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL, stderr=open("err", "w"))
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024)' "$@") || fail "$*"
}

# Images of a coarse and a fine pattern, no two alike, and one small one.
python3 - "$files" "$size" <<'P'
import sys
files, size = int(sys.argv[1]), int(sys.argv[2])
def write(name, n, seed):
    row = bytes((x // 3 * (7 + seed) + (x * x // 97) % 60) % 251 for x in range(3 * n))
    with open(name, "wb") as f:
        f.write(b"P6 %d %d 255\n" % (n, n))
        for y in range(n):
            k = (y * (13 + seed) // 5) % (3 * n)
            f.write(row[k:] + row[:k])
for i in range(files):
    write("t%d.ppm" % i, size, i)
write("small.ppm", 1000, 99)
P

# scene FILTER NAME...: a row of tilted squares and a floor, with a texture each.
scene() {
    local filter=$1 i=0
    shift
    echo '<integrator type="path" depth="3"><sampler type="sobol" count="4"/><scene>
      <camera type="perspective" width="320" height="180" fov="60">
        <transform><lookat origin="0,-6,3" target="0,0,0.5" up="0,0,-1"/></transform></camera>
      <light type="envmap"><texture type="constant" value="1"/></light>'
    for name in "$@"; do
        echo '<instance><shape type="rectangle"/><bsdf type="diffuse">'
        if [ -n "$filter" ]; then
            echo "<texture name=\"albedo\" type=\"image\" filter=\"$filter\" filename=\"$name\"/>"
        else
            echo '<texture name="albedo" type="constant" value="0.5"/>'
        fi
        echo "</bsdf><transform><scale value=\"1.2\"/><rotate axis=\"1,0,0\" angle=\"$((20 + 11 * i % 60))\"/>
          <translate x=\"$((i % 5 * 2 - 4))\" y=\"$((i / 5 * 2 - 2))\"/></transform></instance>"
        i=$((i + 1))
    done
    echo '</scene></integrator>'
}
names=()
for ((i = 0; i < files; i++)); do names+=("t$i.ppm"); done
scene "" "${names[@]}" >plain.xml
scene mipmap "${names[@]}" small.ppm >mipmap.xml
scene bilinear "${names[@]}" small.ppm >bilinear.xml
scene mipmap small.ppm >small.xml

# The first render converts, and says so; the next do not.
expect 0 "$weft" render mipmap.xml -o first.exr --texture-memory "${memory}M"
has "converting" err
expect 0 "$weft" render mipmap.xml -o again.exr --texture-memory "${memory}M"
grep -q converting err && fail "converted again"

peak "$weft" render plain.xml -o plain.exr
plain=$peak
for filter in mipmap bilinear; do
    peak "$weft" render $filter.xml -o $filter.exr --texture-memory "${memory}M"
    echo "$filter: $((files * size * size * 3 / 1000000)) MB of texels, cap $memory MB: peak $peak MB, $plain MB without textures"
    # The rest is the cache's own: its tables, open files, and the tiles in use.
    [ $((peak - plain)) -le $((memory + 40)) ] || fail "$filter: textures took $((peak - plain)) MB of $memory MB"
    expect 0 "$weft" render $filter.xml -o wide.exr --texture-memory 8G --threads 1
    expect 0 "$weft" compare $filter.exr wide.exr --mae 0
done
expect 0 "$weft" compare first.exr mipmap.exr --mae 0
expect 1 "$weft" compare bilinear.exr mipmap.exr --mae 0

# In memory or in tiles: the same bits.
expect 0 "$weft" render small.xml -o memory.exr
grep -q converting err && fail "a small texture was converted"
expect 0 "$weft" render small.xml -o tiles.exr --texture-memory 1M
has "converting" err
expect 0 "$weft" compare memory.exr tiles.exr --mae 0
expect 0 "$weft" info small.xml
has "1 in memory" out
expect 0 "$weft" info mipmap.xml --texture-memory "${memory}M"
has "in tiles" out

# maketx, and a texture made by it.
expect 0 "$weft" maketx small.ppm
[ -s small.tx ] || fail "no small.tx"
expect 0 "$weft" maketx small.ppm t0.ppm -o cache
[ -s cache/t0.tx ] || fail "no cache/t0.tx"
scene mipmap small.tx >tx.xml
expect 0 "$weft" render tx.xml -o tx.exr
expect 0 "$weft" compare memory.exr tx.exr --mae 0
expect 2 "$weft" maketx small.tx
has "the same file" err
expect 2 "$weft" maketx missing.png
has "missing.png" err
expect 2 "$weft" maketx small.ppm t0.ppm -o one.tx
head -c 100000 small.tx >cut.tx
scene mipmap cut.tx >cut.xml
expect 2 "$weft" render cut.xml -o cut.exr
has "cut.tx" err

# A folder that cannot be: a warning, and the picture all the same.
expect 0 "$weft" render small.xml -o fallback.exr --texture-memory 1M --texture-cache small.ppm/no
has "read whole" err
expect 0 "$weft" compare memory.exr fallback.exr --mae 0
expect 2 "$weft" render small.xml --texture-memory lots

[ $failures = 0 ] && echo "textures keep to their memory and their bits"
exit $((failures > 0))
