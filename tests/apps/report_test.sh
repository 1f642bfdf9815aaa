#!/bin/bash
# report_test.sh WEFT SOURCE: the page of `weft compare --report`, its numbers, and in a headless Chromium
# that its line moves and its pictures are right. Without Chromium only the page is looked at (exit 77).
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1

# A reference of one grey, and pictures that are darker on the left and brighter on the right.
cat >s.xml <<'X'
<integrator type="path"><image id="grey"/><sampler type="sobol" count="1"/>
  <scene><camera type="perspective" id="cam" width="64" height="48"/>
    <light type="envmap" id="sky"><texture type="constant" value="0.25"/></light></scene></integrator>
X
expect 0 "$weft" render s.xml -o reference.exr --progress none
expect 0 "$weft" render s.xml -o dim.exr --progress none --set sky.texture.value=0.125
expect 0 "$weft" render s.xml -o 'bright<b>.exr' --progress none --set sky.texture.value=0.5

expect 1 "$weft" compare dim.exr 'bright<b>.exr' reference.exr --report page.html --mae 0.2
has "MAE     1.250000e-01" out
has "MAE     2.500000e-01" out
expect 0 "$weft" compare dim.exr reference.exr --flip 1
has "FLIP    0." out
expect 1 "$weft" compare dim.exr reference.exr --flip 0.01
expect 2 "$weft" compare dim.exr reference.exr --report page.txt
has ".html" err
expect 2 "$weft" compare dim.exr
expect 2 "$weft" compare dim.exr dim.exr reference.exr --diff d.png
expect 2 "$weft" compare dim.exr reference.exr --report nowhere/page.html
has "nowhere/page.html" err

if grep -qE '(src|href)="?(http|//)|url\(|@import|fetch\(' page.html; then fail "the page asks for other files"; fi
python3 - <<'P' || fail "the page's data is not what was compared"
import json, re
text = open("page.html").read()
data = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', text, re.S)[1])
names = [p["name"] for p in data["pictures"]]
assert names == ["dim.exr", "bright<b>.exr", "reference.exr"], names
kinds = [m["name"] for m in data["metrics"]]
mse = [p["metrics"][kinds.index("MSE")] for p in data["pictures"][:2]]
assert abs(mse[0] - 0.125**2) < 1e-6 and abs(mse[1] - 0.25**2) < 1e-6, mse
assert "metrics" not in data["pictures"][2]
P

browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
if [ -z "$browser" ]; then
    [ $failures = 0 ] || exit 1
    echo "skipped: no Chromium here to open the page in (apt-get install chromium)"
    exit 77
fi

# What a user would do, and what the page shows after it, as JSON at the page's end.
cat >actions.html <<'H'
<script>
(async () => {
    const result = {}, wait = () => new Promise(r => setTimeout(r, 50));
    try {
        while (!document.documentElement.dataset.ready) await new Promise(r => setTimeout(r, 20));
        await wait();
        const stage = document.getElementById("stage"), handle = document.getElementById("handle");
        const box = stage.getBoundingClientRect(), canvas = document.getElementById("canvas");
        const move = (type, target, x, y = box.height / 2) => target.dispatchEvent(new PointerEvent(type,
            {bubbles: true, clientX: box.left + x, clientY: box.top + y, pointerId: 1}));
        // Of the picture's pixel x at half its height.
        const colour = x => {
            const px = (box.width / 2 + (x - width / 2) * zoom()) * devicePixelRatio;
            return [...context.getImageData(px, canvas.height / 2, 1, 1).data].slice(0, 3);
        };
        result.before = [handle.getAttribute("aria-valuenow"), colour(20), colour(44)];
        move("pointerdown", handle, box.width / 2);
        move("pointermove", stage, box.width * 0.25);
        move("pointerup", stage, box.width * 0.25);
        await wait();
        result.line = [handle.getAttribute("aria-valuenow"), handle.style.left, colour(20)];
        dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowRight"}));
        result.key = handle.getAttribute("aria-valuenow");
        document.getElementById("exposure").value = 1;
        document.getElementById("exposure").dispatchEvent(new Event("input"));
        await wait();
        result.exposed = colour(44);
        document.querySelector("[data-mode=difference]").click();
        await wait();
        result.difference = colour(44);
        document.querySelector("[data-mode=flip]").click();
        await wait();
        result.flip = colour(44);
        const fitted = zoom();
        document.getElementById("in").click();
        result.zoom = zoom() / fitted;
        await wait();
        move("pointermove", stage, box.width / 2);
        result.probe = document.getElementById("probe").textContent;
        result.table = [...document.querySelectorAll("#metrics td")].map(c => c.textContent);
        result.address = location.hash;
    } catch (e) { result.error = String(e); }
    const pre = document.createElement("pre");
    pre.id = "result";
    pre.textContent = "RESULT" + JSON.stringify(result) + "RESULT";
    document.body.append(pre);
})();
</script>
H
cat page.html actions.html >driven.html
"$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --window-size=1200,800 \
    --virtual-time-budget=20000 --dump-dom "file://$work/driven.html" >dom 2>err || fail "the browser failed"
python3 - <<'P' || fail "the page does not behave"
import html, json, re
found = re.search(r'<pre id="result">RESULT(.*?)RESULT</pre>', open("dom").read(), re.S)
assert found, "no result"
r = json.loads(html.unescape(found[1]))
assert "error" not in r, r
near = lambda a, b: all(abs(x - y) <= 1 for x, y in zip(a, b))
srgb = lambda x: round(255 * (1.055 * x ** (1 / 2.4) - 0.055))
assert r["before"][0] == "50", r
assert near(r["before"][1], 3 * [srgb(0.125)]) and near(r["before"][2], 3 * [srgb(0.25)]), r
assert r["line"][0] == "25" and r["line"][1] == "25%", r   # now the reference is under pixel 20
assert near(r["line"][2], 3 * [srgb(0.25)]), r
assert r["key"] == "27", r
assert near(r["exposed"], 3 * [srgb(0.5)]), r
assert r["difference"][0] == 0 and abs(r["difference"][2] - srgb(0.25)) <= 1, r   # dim: blue
assert r["flip"][0] > 60 and r["flip"][0] != r["flip"][1], r
assert abs(r["zoom"] - 1.5) < 1e-6, r
assert "dim.exr 0.125, 0.125, 0.125" in r["probe"] and "reference.exr 0.250" in r["probe"], r
assert "1.562e-2" in r["table"] or "1.563e-2" in r["table"], r
assert "6.250e-2" in r["table"] and "bright<b>.exr" in r["table"], r
assert "mode=flip" in r["address"], r
P
[ $failures = 0 ] && echo "the report works"
exit $((failures > 0))
