#include "io/eyes/picture_slot.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <new>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace godwit::io::eyes {
namespace {

constexpr std::uint64_t magic = 0x32746f6c53657947; // "GyeSlot2"
constexpr std::size_t buffers = 3;
constexpr int max_looks = 4; // a writer that outruns a reader so often is no writer of pictures

struct buffer {
  std::atomic<std::uint64_t> number; // of its picture
  std::int64_t captured_ns;
  std::int32_t width_px;
  std::int32_t height_px;
  std::uint64_t size;
  std::array<std::byte, max_picture_bytes> bytes;
};

struct small_buffer {
  std::atomic<std::int64_t> captured_ns; // 0: it is being written, or there is none
  std::uint32_t track;
  std::int32_t width_px;
  std::int32_t height_px;
  std::uint64_t size;
  std::array<std::byte, max_cutout_bytes> bytes;
};

} // namespace

struct picture_slot::layout {
  std::uint64_t magic;
  std::atomic<std::uint64_t> newest; // 0: none
  std::array<buffer, buffers> all;
  std::array<small_buffer, max_cutouts> cutouts;
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "a lock would be of one process alone");

tl::expected<picture_slot::layout*, std::string> picture_slot::map(int number) {
  void* const at = ::mmap(nullptr, sizeof(layout), PROT_READ | PROT_WRITE, MAP_SHARED, number, 0);
  if (at == MAP_FAILED)
    return tl::make_unexpected(std::string("the memory for pictures can not be mapped: ") + std::strerror(errno));
  return static_cast<layout*>(at);
}

tl::expected<picture_slot, std::string> picture_slot::make() {
  link::descriptor memory(::memfd_create("godwit-picture", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!memory.is_open() || ::ftruncate(memory.number(), sizeof(layout)) != 0 ||
      ::fcntl(memory.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    return tl::make_unexpected(std::string("no memory for pictures can be had: ") + std::strerror(errno));
  return map(memory.number()).map([&](layout* at) {
    at->magic = magic; // what is not written is 0
    return picture_slot(std::move(memory), at);
  });
}

tl::expected<picture_slot, std::string> picture_slot::attach(link::descriptor memory) {
  struct stat about {};
  if (::fstat(memory.number(), &about) != 0 || about.st_size != static_cast<off_t>(sizeof(layout)))
    return tl::make_unexpected(std::string("the descriptor is no memory for pictures"));
  auto at = map(memory.number());
  if (!at)
    return tl::make_unexpected(std::move(at.error()));
  if ((*at)->magic != magic) {
    static_cast<void>(::munmap(*at, sizeof(layout)));
    return tl::make_unexpected(std::string("the memory for pictures is of another build"));
  }
  return picture_slot(std::move(memory), *at);
}

picture_slot::picture_slot(picture_slot&& other) noexcept
    : memory_(std::move(other.memory_)), mapped_(std::exchange(other.mapped_, nullptr)) {}

picture_slot::~picture_slot() {
  if (mapped_ != nullptr)
    static_cast<void>(::munmap(mapped_, sizeof(layout)));
}

bool picture_slot::publish(std::span<const std::byte> jpeg, std::int64_t captured_ns, std::int32_t width_px,
                           std::int32_t height_px) {
  if (jpeg.size() > max_picture_bytes)
    return false;
  const auto number = mapped_->newest.load(std::memory_order_relaxed) + 1;
  auto& to = mapped_->all[number % buffers];
  to.number.store(0, std::memory_order_relaxed); // it is being written
  std::atomic_thread_fence(std::memory_order_release);
  to.captured_ns = captured_ns;
  to.width_px = width_px;
  to.height_px = height_px;
  to.size = jpeg.size();
  std::memcpy(to.bytes.data(), jpeg.data(), jpeg.size());
  to.number.store(number, std::memory_order_release);
  mapped_->newest.store(number, std::memory_order_release);
  return true;
}

std::optional<picture> picture_slot::read(std::uint64_t after) const {
  for (int looks = 0; looks < max_looks; ++looks) {
    const auto newest = mapped_->newest.load(std::memory_order_acquire);
    if (newest <= after)
      return std::nullopt;
    const auto& from = mapped_->all[newest % buffers];
    if (from.number.load(std::memory_order_acquire) != newest)
      continue;
    const std::uint64_t size = from.size; // read once: the other side may change it
    if (size > max_picture_bytes)
      return std::nullopt;
    picture result{newest, from.captured_ns, from.width_px, from.height_px, {}};
    result.jpeg.assign(from.bytes.begin(), from.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    std::atomic_thread_fence(std::memory_order_acquire);
    if (from.number.load(std::memory_order_relaxed) == newest)
      return result;
  }
  return std::nullopt;
}

bool picture_slot::publish_cutout(std::uint32_t track, std::span<const std::byte> jpeg, std::int64_t captured_ns,
                                  std::int32_t width_px, std::int32_t height_px) {
  if (jpeg.size() > max_cutout_bytes || captured_ns <= 0)
    return false;
  auto& to = mapped_->cutouts[track % max_cutouts];
  to.captured_ns.store(0, std::memory_order_relaxed); // it is being written
  std::atomic_thread_fence(std::memory_order_release);
  to.track = track;
  to.width_px = width_px;
  to.height_px = height_px;
  to.size = jpeg.size();
  std::memcpy(to.bytes.data(), jpeg.data(), jpeg.size());
  to.captured_ns.store(captured_ns, std::memory_order_release);
  return true;
}

std::optional<cutout> picture_slot::read_cutout(std::uint32_t track) const {
  const auto& from = mapped_->cutouts[track % max_cutouts];
  for (int looks = 0; looks < max_looks; ++looks) {
    const auto captured_ns = from.captured_ns.load(std::memory_order_acquire);
    const std::uint64_t size = from.size; // read once: the other side may change it
    if (captured_ns <= 0 || from.track != track || size > max_cutout_bytes)
      continue;
    cutout result{track, captured_ns, from.width_px, from.height_px, {}};
    result.jpeg.assign(from.bytes.begin(), from.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    std::atomic_thread_fence(std::memory_order_acquire);
    if (from.captured_ns.load(std::memory_order_relaxed) == captured_ns)
      return result;
  }
  return std::nullopt;
}

void picture_slot::clear() {
  for (auto& each : mapped_->all)
    each.number.store(0);
  for (auto& each : mapped_->cutouts)
    each.captured_ns.store(0);
  mapped_->newest.store(0);
}

} // namespace godwit::io::eyes
