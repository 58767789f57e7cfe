#include "io/eyes/picture_slot.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace godwit::io::eyes {
namespace {

constexpr std::uint64_t magic = 0x33746f6c53657947; // "GyeSlot3"
constexpr std::size_t buffers = 3;
constexpr int max_looks = 4; // a writer that outruns a reader so often is no writer of pictures

// Written by one side and read by the other without a lock: by the stamp who reads sees whether it stayed whole.
template <std::size_t Most>
struct cell {
  std::atomic<std::uint64_t> stamp; // 0: it is being written, or there is nothing
  std::int64_t captured_ns;
  std::uint32_t track; // of a cut-out
  std::int32_t width_px;
  std::int32_t height_px;
  std::uint64_t size;
  std::array<std::byte, Most> bytes;

  void write(std::uint64_t under, std::uint32_t of_track, std::span<const std::byte> jpeg, std::int64_t at_ns,
             std::int32_t width, std::int32_t height) {
    stamp.store(0, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    captured_ns = at_ns;
    track = of_track;
    width_px = width;
    height_px = height;
    size = jpeg.size();
    std::ranges::copy(jpeg, bytes.begin());
    stamp.store(under, std::memory_order_release);
  }

  // Nothing: it has another stamp, or it was written meanwhile.
  [[nodiscard]] std::optional<cutout> read(std::uint64_t under) const {
    if (under == 0 || stamp.load(std::memory_order_acquire) != under)
      return std::nullopt;
    const std::uint64_t now = size; // read once: the other side may change it
    if (now > Most)
      return std::nullopt;
    cutout result{track, captured_ns, width_px, height_px, {}};
    result.jpeg.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(now));
    std::atomic_thread_fence(std::memory_order_acquire);
    if (stamp.load(std::memory_order_relaxed) != under)
      return std::nullopt;
    return result;
  }
};

} // namespace

struct picture_slot::layout {
  std::uint64_t magic;
  std::atomic<std::uint64_t> newest; // 0: none
  std::array<cell<max_picture_bytes>, buffers> all;
  std::array<cell<max_cutout_bytes>, max_cutouts> cutouts; // the stamp is the time
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
  mapped_->all[number % buffers].write(number, 0, jpeg, captured_ns, width_px, height_px);
  mapped_->newest.store(number, std::memory_order_release);
  return true;
}

std::optional<picture> picture_slot::read(std::uint64_t after) const {
  for (int looks = 0; looks < max_looks; ++looks) {
    const auto newest = mapped_->newest.load(std::memory_order_acquire);
    if (newest <= after)
      return std::nullopt;
    if (auto seen = mapped_->all[newest % buffers].read(newest))
      return picture{newest, seen->captured_ns, seen->width_px, seen->height_px, std::move(seen->jpeg)};
  }
  return std::nullopt;
}

bool picture_slot::publish_cutout(std::uint32_t track, std::span<const std::byte> jpeg, std::int64_t captured_ns,
                                  std::int32_t width_px, std::int32_t height_px) {
  if (jpeg.size() > max_cutout_bytes || captured_ns <= 0)
    return false;
  mapped_->cutouts[track % max_cutouts].write(static_cast<std::uint64_t>(captured_ns), track, jpeg, captured_ns,
                                              width_px, height_px);
  return true;
}

std::optional<cutout> picture_slot::read_cutout(std::uint32_t track) const {
  const auto& from = mapped_->cutouts[track % max_cutouts];
  for (int looks = 0; looks < max_looks; ++looks) {
    auto seen = from.read(from.stamp.load(std::memory_order_acquire));
    if (seen && seen->captured_ns > 0 && seen->track == track)
      return seen;
  }
  return std::nullopt;
}

void picture_slot::clear() {
  for (auto& each : mapped_->all)
    each.stamp.store(0);
  for (auto& each : mapped_->cutouts)
    each.stamp.store(0);
  mapped_->newest.store(0);
}

} // namespace godwit::io::eyes
