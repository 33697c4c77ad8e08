#!/usr/bin/env bash
# Runs utilities in a fresh copy of a case, then a Python script that asserts on what came out.
#
#   caseTest.sh NAME CASE [-set FILE WORD VALUE]... COMMAND... -check SCRIPT [ARGUMENTS]
#
#   NAME      the copy is <build>/tests/cases/NAME; it stays there for a look
#   CASE      folder below cases/ (dictionaries, geometry and Allrun are copied, no results)
#   -set      changes an entry of the copy, as in: -set system/gridDict cellSize 0.4
#   COMMAND   one argument a command line, as in: 'mpmSolve -threads 2'
#   -check    SCRIPT below tests/cases/, called as: SCRIPT <copy> ARGUMENTS
#
# MPM_BUILD_DIR names the build (default: build/).

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P) || exit 1
export MPM_BUILD_DIR=${MPM_BUILD_DIR:-$project/build}
# shellcheck source=etc/bashrc
. "$project/etc/bashrc"

fail()
{
    echo "caseTest.sh: $1" >&2
    exit 1
}

# Replaces the value of an entry that stands on a line of its own; the comment behind it stays.
setEntry()
{
    local file=$1 word=$2 value=$3
    grep -Eq "^[[:space:]]*${word}[[:space:]][^;]*;" "$file" || fail "$file has no entry $word"
    sed -Ei "s|^([[:space:]]*${word}[[:space:]]+)[^;]*;|\1$value;|" "$file"
}

name=$1
source=$project/cases/$2
copy=$MPM_BUILD_DIR/tests/cases/$name
shift 2
[ -d "$source" ] || fail "no case $source"
rm -rf "$copy"
mkdir -p "$copy" || fail "cannot write $copy"
for part in geometry constant system Allrun
do
    [ -e "$source/$part" ] && cp -r "$source/$part" "$copy/"
done
cd "$copy" || exit 1

while [ $# -gt 0 ]
do
    case $1 in
        -set)
            setEntry "$2" "$3" "$4"
            shift 4
            ;;
        -check)
            script=$2
            shift 2
            exec /usr/bin/python3 "$project/tests/cases/$script" "$copy" "$@"
            ;;
        *)
            echo "$1"
            eval "$1" > log.caseTest 2>&1 < /dev/null || { tail -n 30 log.caseTest; fail "'$1' failed in $copy"; }
            shift
            ;;
    esac
done
fail "no -check"
