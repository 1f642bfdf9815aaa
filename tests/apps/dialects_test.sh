#!/bin/bash
# dialects_test.sh WEFT SOURCE: scene files of other dialects are rendered with notes, and converted.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
without_dates
cd "$work"
cp -r "$source/tests/io/dialects" "$source/tests/io/bad" .
chmod -R u+w .

# --- notes, and pictures of a file that is converted into another folder
mkdir old converted elsewhere
old="dialects/image_child.xml"
expect 0 "$weft" render $old -o old --progress none
sed 's/^/note: dialects\//' dialects/image_child.notes >notes
grep '^note: ' err | cmp -s - notes || fail "other notes"
expect 0 "$weft" convert $old elsewhere/new.xml
cmp -s err notes || fail "other notes of convert"
expect 0 "$weft" render elsewhere/new.xml -o converted --progress none
grep '^note: ' err && fail "the converted file needs notes"
[ -e old/picture.exr ] && diff -rq old converted || fail "another picture when converted"
expect 0 "$weft" info dialects/tone_mapping.xml
sed 's/^/note: dialects\//' dialects/tone_mapping.notes >notes
grep '^note: ' out | cmp -s - notes || fail "other notes of info"

# --- in place, and not at all
cp dialects/lens_radius.xml own.xml
expect 0 "$weft" convert own.xml own.xml
cmp -s own.xml dialects/lens_radius_today.xml || fail "not converted in place"
printf '<scene><camera type="thinlens" radius="1" lensRadius="2"/></scene>' >both.xml
cp both.xml before.xml
for new in both.xml new.xml; do
    expect 2 "$weft" convert both.xml $new
    has "both.xml:1:32: 'radius' of <camera type=\"thinlens\"> is called 'lensRadius' today, which is given, too" err
done
cmp -s both.xml before.xml || fail "an error changed the file"
[ -e new.xml ] && fail "an error left a file"
expect 2 "$weft" convert none.xml new.xml
expect 2 "$weft" convert own.xml missing/new.xml
expect 2 "$weft" convert model.glb new.xml
has "found a glTF file" err

# --- words
expect 0 "$weft" help thinlens
has "focusDistance" out
has "is called \`focalDistance\` today" out
expect 0 "$weft" help aov
has 'type="normals"' out
expect 0 "$weft" schema --json
has '"apertureRadius"' out

exit $((failures > 0))
