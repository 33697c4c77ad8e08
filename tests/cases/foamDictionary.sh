#!/usr/bin/env bash
# OpenFOAM's own foamDictionary reads every dictionary we ship, and understands it as we do: it prints the same from the
# file as from the text that our reader makes of the file.
#
#   foamDictionary.sh DICTIONARYTEXT [PROJECT]      DICTIONARYTEXT is the test program of that name
#
# Exit code 77 (skipped) without foamDictionary: Debian package openfoam, or an OpenFOAM environment.

program=$1
project=$(cd "${2:-$(dirname "${BASH_SOURCE[0]}")/../..}" && pwd -P) || exit 1

if ! command -v foamDictionary > /dev/null
then
    echo "skipped: foamDictionary is not installed (Debian: apt-get install openfoam)"
    exit 77
fi
[ -z "$WM_PROJECT_DIR" ] && [ -d /usr/share/openfoam ] && export WM_PROJECT_DIR=/usr/share/openfoam

work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failures=0 count=0
declare -A known

# What foamDictionary prints of a dictionary of a case, without its banner, which holds the file's name.
expand()
{
    (cd "$2" && foamDictionary "$1" -expand) > "$work/raw" 2> "$work/error" || return 1
    sed '/^\/\*/,/^\\\*/d; /^\/\//d' "$work/raw"
}

fail()
{
    echo "failed: $1"
    [ -s "$work/error" ] && sed 's/^/    /' "$work/error"
    failures=$((failures + 1))
}

check()
{
    local file=$1 case=$2 same
    # The same text means the same, unless it takes from other files.
    same=$(md5sum < "$file")
    if grep -q '^[[:space:]]*#' "$file"
    then
        same+=$case
    fi
    [ -n "${known[$same]}" ] && return
    known[$same]=$file
    count=$((count + 1))
    : > "$work/error"
    expand "$file" "$case" > "$work/theirs" || { fail "foamDictionary cannot read $file"; return; }
    "$program" "$file" "$case" > "$work/text" 2> "$work/error" || { fail "we cannot read $file"; return; }
    expand "$work/text" "$case" > "$work/ours" || { fail "foamDictionary cannot read our text of $file"; return; }
    diff "$work/theirs" "$work/ours" > "$work/error" || { fail "$file is understood in two ways"; return; }
    [ -s "$work/ours" ] || { fail "foamDictionary prints nothing of $file"; return; }
    echo "read: ${file#"$project"/}"
}

while IFS= read -r -d '' file
do
    check "$file" "$(dirname "$(dirname "$file")")"
done < <(find "$project/cases" "$project/etc/caseTemplates" "$project/tests" -type f \
    \( -path '*/constant/*' -o -path '*/system/*' \) ! -path '*/build*/*' -print0 2> /dev/null | sort -z)
while IFS= read -r -d '' file
do
    check "$file" "$project/etc"
done < <(find "$project/etc/caseDicts" -type f -print0 2> /dev/null | sort -z)

[ "$count" -gt 0 ] || { echo "failed: no dictionaries below $project/cases"; exit 1; }
echo "$count dictionaries, $failures failures"
[ "$failures" -eq 0 ]
