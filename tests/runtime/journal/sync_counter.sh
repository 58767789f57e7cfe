#!/bin/sh
# Every commit reaches the disk: the kernel sees at least one fdatasync for each.
# Usage: sync_counter.sh PROGRAM FOLDER; exit 77 = can not be tested here.
set -eu
program=$1
folder=$2/sync_counter.$$
commits=200

command -v strace >/dev/null || { echo "strace is not installed"; exit 77; }
strace -o /dev/null true 2>/dev/null || { echo "strace may not trace here"; exit 77; }

mkdir -p "$folder"
trap 'rm -rf "$folder"' EXIT
counted=$(strace -f -c -e trace=fdatasync,fsync -o "$folder/syscalls" "$program" "$folder/journal.db" "$commits")
synced=$(awk '$NF == "fdatasync" || $NF == "fsync" { sum += $4 } END { print sum + 0 }' "$folder/syscalls")
echo "$counted commits, $synced syncs"
if [ "$counted" -lt "$commits" ] || [ "$synced" -lt "$counted" ]; then
  echo "a commit was acknowledged without a sync"
  exit 1
fi
