"""What godwitd takes of the machine, sampled, and whether it grows."""

import os
import statistics
from pathlib import Path

# May be so much more in the last quarter than in the second one. Memory: the allocator keeps what bursts have taken.
ROOM = {
    "memory_kib": lambda before: max(8 * 1024, before * 0.1),
    "descriptors": lambda before: 2,
    "threads": lambda before: 1,
    "journal_kib": lambda before: max(8 * 1024, before * 0.1),
    "trace_kib": lambda before: None,  # it has a bound of its own, and grows until then
}
TRACE_BOUND_KIB = 288 * 1024  # 256 MiB, and a file that is begun before the oldest goes


def kib_of(paths):
    total = 0
    for path in paths:
        try:
            total += path.stat().st_size
        except FileNotFoundError:
            continue  # the oldest files go first
    return total // 1024


def sample(pid, folder, at_s):
    process = Path("/proc", str(pid))
    status = dict(
        line.split(":", 1) for line in (process / "status").read_text(encoding="utf-8").splitlines() if ":" in line
    )
    return {
        "at_s": round(at_s, 1),
        "memory_kib": int(status["VmRSS"].split()[0]),
        "descriptors": len(os.listdir(process / "fd")),
        "threads": int(status["Threads"]),
        "journal_kib": kib_of(folder.glob("godwit.db*")),
        "trace_kib": kib_of((folder / "trace").rglob("*")),
    }


def quarter(samples, number):
    return samples[len(samples) * (number - 1) // 4 : len(samples) * number // 4]


def figures(samples):
    """By name: the median of the second and of the last quarter, and the most of all."""
    result = {}
    for name in ROOM if len(samples) >= 8 else ():
        second, last = ([each[name] for each in quarter(samples, number)] for number in (2, 4))
        result[name] = {
            "second_quarter": int(statistics.median(second)),
            "last_quarter": int(statistics.median(last)),
            "most": max(each[name] for each in samples),
        }
    return result


def growths(samples):
    """A sentence for each that has grown."""
    found = figures(samples)
    if not found:
        return ["there are too few samples to tell"]
    result = []
    for name, row in found.items():
        room = ROOM[name](row["second_quarter"])
        if room is not None and row["last_quarter"] > row["second_quarter"] + room:
            result.append(f"{name} has grown from {row['second_quarter']:,} to {row['last_quarter']:,}")
    if found["trace_kib"]["most"] > TRACE_BOUND_KIB:
        result.append(f"the trace has {found['trace_kib']['most']:,} KiB, more than its bound")
    return result
