#!/bin/bash
# install_test.sh WEFT SOURCE: what `cmake --install` puts under a prefix works from anywhere: the program
# with its materials, scenes and weights, completion in shells, and the manual page.
set -uo pipefail
. "$(dirname "$0")/checks.sh"
cd "$work" || exit 1

expect 0 cmake --install "$(dirname "$weft")" --prefix "$work/first"
mv first prefix # nothing may know the prefix
PATH=$work/prefix/bin:$PATH
[ "$(command -v weft)" = "$work/prefix/bin/weft" ] || fail "no program in bin"
share=$work/prefix/share
unset WEFT_WEIGHTS XDG_DATA_DIRS
export HOME=$work/home XDG_DATA_HOME=$work/home
mkdir home elsewhere
cd elsewhere || exit 1

# Scenes, materials and help.
cat >ball.xml <<'X'
<include filename="materials/gold.xml"/>
<scene>
  <camera type="perspective" width="16" height="16"><transform><translate z="-4"/></transform></camera>
  <light type="envmap"/>
  <instance><shape type="sphere"/><ref id="gold"/></instance>
</scene>
X
expect 0 weft render ball.xml -o ball.exr --spp 1 --aov denoise_albedo,denoise_normal --progress none
expect 0 weft render "$share/weft/scenes/demo.xml" -o demo.png --spp 1 --size 5% --progress none
[ -s demo.png ] || fail "demo.png is missing"
expect 0 weft help gold
cmp -s out "$share/weft/scenes/materials/gold.xml" || fail "weft help gold is not the installed file"
[ -s "$share/doc/weft/docs/reference/README.md" ] || fail "the reference is missing"

# The weights, where they had been fetched.
if [ -d "$share/weft/weights" ]; then
    expect 0 weft denoise ball.exr -o clean.exr --backend network
else
    expect 2 weft denoise ball.exr -o clean.exr --backend network
    has "$share/weft/weights" err
fi

# Completion. Names of files have spaces and capitals, and folders lie on the way to them.
mkdir pictures
touch "a scene.XML" model.glb notes.txt pictures/one.exr part.weft
# complete_bash WORD...: what bash offers for the last word of this line, a line each.
complete_bash() {
    bash -c '. "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _weft; printf "%s\n" "${COMPREPLY[@]}"' \
        "$share/bash-completion/completions/weft" "$@" | LC_ALL=C sort | paste -sd '|'
}
offers() { # offers WANTED WORD...
    local wanted=$1 found
    shift
    found=$(complete_bash "$@")
    [ "$found" = "$wanted" ] || fail "expected '$wanted' for '$*', found '$found'"
}
offers 'render|replay' weft re
offers '--profile|--progress' weft render --pro
offers 'auto|json|none' weft render --progress ''
offers 'json' weft render --progress = j
offers 'a scene.XML|ball.xml|model.glb|pictures' weft render ''
offers 'a scene.XML' weft render --spp 4 a
offers 'pictures/one.exr' weft compare ball.exr pictures/
offers 'part.weft|pictures' weft merge p
offers 'pictures' weft docs ''
offers 'disk|disney|display' weft help dis
offers 'glare|threshold' weft bloom ball.exr --kind ''
offers '' weft render --spp ''
for command in $(weft completion bash | sed -nE "s/^ *\(\(COMP_CWORD == 1\)\) && _weft_words '([^']*)'.*/\1/p"); do
    case $command in -*) ;; *) expect 0 weft "$command" --help ;; esac
done
for command in $(weft --help | sed '1,/^Subcommands:/d' | awk '/^  [a-z]/ { print $1 }'); do
    offers "$command" weft "$command"
done
if command -v zsh >/dev/null; then expect 0 zsh -n "$share/zsh/site-functions/_weft"; fi
if command -v fish >/dev/null; then
    script=$share/fish/vendor_completions.d/weft.fish
    expect 0 fish -c "source $script; complete -C 'weft re'"
    has replay out
    expect 0 fish -c "source $script; complete -C 'weft render '"
    has 'a scene.XML' out
    has pictures/ out
    grep -q notes.txt out && fail "fish offers notes.txt as a scene"
    expect 0 fish -c "source $script; complete -C 'weft render --progress '"
    has json out
fi
expect 2 weft completion tcsh

# The manual page tells of every command and option, and has no mistake that roff would find.
page=$share/man/man1/weft.1
if command -v groff >/dev/null; then
    expect 0 groff -man -Tutf8 -ww "$page"
    [ ! -s err ] || fail "the manual page has mistakes"
fi
for option in $(weft render --help | grep -oE '^ +(-o,)?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
    has "\\fB${option//-/\\-}\\fR" "$page"
done

[ $failures = 0 ] && echo "what is installed works"
exit $((failures > 0))
