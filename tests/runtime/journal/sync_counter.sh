#!/bin/sh
# Every commit reaches the disk: the kernel sees at least one fdatasync for each.
#
# Opening and closing sync too. So the program runs twice, the second time with twice as many commits, and what the
# second run has more in commits it must have more in syncs.
# Usage: sync_counter.sh PROGRAM FOLDER
set -eu
program=$1
folder=$2/sync_counter.$$
commits=200

fail() {
  echo "sync_counter: $1"
  exit 1
}

command -v strace >/dev/null || fail "strace is not installed: apt-get install strace"
strace -o /dev/null true 2>/dev/null ||
  fail "strace may not trace here: allow ptrace (docker run --cap-add=SYS_PTRACE; kernel.yama.ptrace_scope below 3)"

mkdir -p "$folder"
trap 'rm -rf "$folder"' EXIT

# Runs the program on a new journal with $1 commits and prints "COMMITS SYNCS", as it and as the kernel counted them.
count() {
  counted=$(strace -f -c -e trace=fdatasync,fsync -o "$folder/$1.syscalls" "$program" "$folder/$1.db" "$1")
  synced=$(awk '$NF == "fdatasync" || $NF == "fsync" { sum += $4 } END { print sum + 0 }' "$folder/$1.syscalls")
  echo "$counted $synced"
}

once=$(count "$commits")
twice=$(count $((2 * commits)))
more_commits=$((${twice% *} - ${once% *}))
more_syncs=$((${twice#* } - ${once#* }))
echo "commits and syncs: $once, then $twice: $more_commits more commits, $more_syncs more syncs"
[ "$more_commits" -ge "$commits" ] || fail "$commits more events, each awaited, made only $more_commits more commits"
[ "$more_syncs" -ge "$more_commits" ] || fail "a commit was acknowledged without a sync"
