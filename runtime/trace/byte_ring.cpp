#include "runtime/trace/byte_ring.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <bit>

#include "runtime/assert.hpp"

namespace godwit::runtime {

std::unique_ptr<byte_ring> byte_ring::make(std::size_t size) {
  GODWIT_ASSERT(std::has_single_bit(size), "the size of a ring is a power of two");
  const int file = ::memfd_create("godwit-trace-ring", MFD_CLOEXEC);
  if (file < 0)
    return nullptr;
  void* both = MAP_FAILED;
  bool mapped = false;
  if (::ftruncate(file, static_cast<off_t>(size)) == 0)
    both = ::mmap(nullptr, size * 2, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (both != MAP_FAILED) {
    auto* first = static_cast<std::byte*>(both);
    const auto map_at = [&](std::byte* where) {
      return ::mmap(where, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file, 0) == where;
    };
    mapped = map_at(first) && map_at(first + size);
    if (!mapped)
      ::munmap(both, size * 2);
  }
  ::close(file);
  return mapped ? std::unique_ptr<byte_ring>(new byte_ring(static_cast<std::byte*>(both), size)) : nullptr;
}

byte_ring::~byte_ring() { ::munmap(memory_, size_ * 2); }

} // namespace godwit::runtime
