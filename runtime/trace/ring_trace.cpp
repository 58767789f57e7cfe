#include "runtime/trace/ring_trace.hpp"

#include <bit>
#include <cstring>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <unistd.h>

#include "io/fields/binary.hpp"
#include "runtime/assert.hpp"
#include "runtime/trace/trace_renderer.hpp"

namespace godwit::runtime {

namespace {

// How a record lies in a ring; the encoded message follows it, then padding to eight bytes.
struct stored_record {
  trace_entry entry;
  const message_type* type = nullptr;
  std::uint32_t payload_bytes = 0;
  bool oversize = false;
};
static_assert(std::is_trivially_copyable_v<stored_record>);

constexpr std::size_t padded(std::size_t bytes) { return (bytes + 7U) & ~std::size_t{7}; }

struct thread_ring {
  std::unique_ptr<byte_ring> ring;
  std::atomic<std::uint64_t> recorded{0};
  std::atomic<std::uint64_t> dropped{0};
  std::atomic<std::uint64_t> oversize{0};
  alignas(64) std::atomic<bool> woke_writer{false}; // on a line of its own: both sides write it
};

std::atomic<std::uint64_t> next_trace_number{1};

// The writer's core has read the memory that comes next; fetching it back takes as long as the rest of record(), so
// begin now. The ring is mapped twice: what lies ahead of any record is always the ring.
void prefetch_for_writing(const std::byte* next) {
  constexpr std::size_t cache_line = 64;
  constexpr int for_writing = 1;
  __builtin_prefetch(next + cache_line, for_writing);
  __builtin_prefetch(next + 2 * cache_line, for_writing);
}

void count(std::atomic<std::uint64_t>& counter) {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); // one writer, its own thread
}

} // namespace

struct ring_trace::shared {
  shared() : number(next_trace_number.fetch_add(1)), wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    GODWIT_ASSERT(wake >= 0, "the process can open one more file descriptor at its start");
  }
  shared(const shared&) = delete;
  shared& operator=(const shared&) = delete;
  ~shared() { ::close(wake); }

  thread_ring* ring_of_this_thread() {
    thread_local std::uint64_t owner = 0; // a thread that records into another trace looks its ring up again
    thread_local thread_ring* mine = nullptr;
    if (owner != number) [[unlikely]] {
      owner = number;
      mine = add_ring();
    }
    return mine;
  }

  thread_ring* add_ring() {
    const std::lock_guard guard(mutex);
    const auto me = std::this_thread::get_id();
    for (std::size_t i = 0; i < rings.size(); ++i)
      if (owners[i] == me)
        return rings[i].get();
    auto ring = rings.size() < max_threads ? byte_ring::make(ring_bytes) : nullptr;
    if (!ring)
      return nullptr;
    rings.push_back(std::make_unique<thread_ring>());
    rings.back()->ring = std::move(ring);
    owners.push_back(me);
    return rings.back().get();
  }

  void wake_writer() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake, &one, sizeof one); // only fails when it is awake already
  }

  std::vector<thread_ring*> all_rings() {
    const std::lock_guard guard(mutex);
    std::vector<thread_ring*> result;
    for (const auto& each : rings)
      result.push_back(each.get());
    return result;
  }

  const std::uint64_t number;
  const int wake;
  std::mutex mutex; // rings and owners
  std::vector<std::unique_ptr<thread_ring>> rings;
  std::vector<std::thread::id> owners;
  std::atomic<std::uint64_t> dropped_without_ring{0};
};

// The thread that empties the rings.
class ring_trace::writer {
public:
  writer(shared& state, std::unique_ptr<trace_renderer> renderer, milliseconds flush)
      : shared_(state), renderer_(std::move(renderer)), flush_(flush), thread_([this] { run(); }) {}
  writer(const writer&) = delete;
  writer& operator=(const writer&) = delete;
  ~writer() { stop(); }

  void stop() {
    if (!thread_.joinable())
      return;
    stopping_.store(true);
    shared_.wake_writer();
    thread_.join();
    renderer_->close();
  }

  [[nodiscard]] const trace_renderer& renderer() const { return *renderer_; }

private:
  void run() {
    while (!stopping_.load()) {
      pollfd waiting{shared_.wake, POLLIN, 0};
      ::poll(&waiting, 1, static_cast<int>(flush_.count()));
      std::uint64_t ignored = 0;
      [[maybe_unused]] const auto got = ::read(shared_.wake, &ignored, sizeof ignored);
      drain();
    }
    drain();
  }

  void drain() {
    auto lost = shared_.dropped_without_ring.load(std::memory_order_relaxed);
    for (auto* each : shared_.all_rings()) {
      each->woke_writer.store(false, std::memory_order_relaxed);
      drain(*each->ring);
      lost += each->dropped.load(std::memory_order_relaxed);
    }
    renderer_->note_dropped(lost);
    renderer_->tick();
  }

  // What is there now; the actors go on recording. Space is given back in pieces, so that a full ring has room again
  // soon and the two threads do not fight over a cache line at each record.
  void drain(byte_ring& ring) {
    constexpr std::size_t piece = ring_bytes / 16;
    std::size_t done = 0;
    for (auto bytes = ring.readable(); !bytes.empty();) {
      stored_record record;
      std::memcpy(&record, bytes.data(), sizeof record);
      const auto size = padded(sizeof record + record.payload_bytes);
      renderer_->write(record.entry, *record.type, bytes.subspan(sizeof record, record.payload_bytes), record.oversize);
      bytes = bytes.subspan(size);
      done += size;
      if (done >= piece || bytes.empty())
        ring.consume(std::exchange(done, 0));
    }
  }

  shared& shared_;
  std::unique_ptr<trace_renderer> renderer_;
  const milliseconds flush_;
  std::atomic<bool> stopping_{false};
  std::thread thread_; // last: it uses all of the above
};

ring_trace::ring_trace(std::unique_ptr<shared> state) : shared_(std::move(state)) {}

ring_trace::~ring_trace() { close(); }

tl::expected<std::unique_ptr<ring_trace>, std::string> ring_trace::open(trace_options options, const directory& names,
                                                                        const time_source& time, health_board& health) {
  const auto flush = options.flush;
  auto renderer = trace_renderer::open(std::move(options), names, time, health);
  if (!renderer)
    return tl::unexpected(renderer.error());
  std::unique_ptr<ring_trace> result(new ring_trace(std::make_unique<shared>()));
  result->writer_ = std::make_unique<writer>(*result->shared_, std::move(*renderer), flush);
  return result;
}

void ring_trace::record(const trace_entry& entry, const message_type& type, const void* body) noexcept {
  auto* const mine = shared_->ring_of_this_thread();
  if (mine == nullptr) [[unlikely]] {
    shared_->dropped_without_ring.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  stored_record record{entry, &type, 0, false};
  const auto space = mine->ring->free_space(sizeof record + max_payload + sizeof(std::uint64_t));
  if (space.size() < sizeof record + sizeof(std::uint64_t)) {
    count(mine->dropped);
    return;
  }
  const auto room = std::min(max_payload, space.size() - sizeof record - sizeof(std::uint64_t));
  io::byte_sink sink(space.subspan(sizeof record, room));
  type.encode(sink, body);
  if (sink.overflow() && room < max_payload) {
    count(mine->dropped);
    return;
  }
  record.oversize = sink.overflow();
  record.payload_bytes = record.oversize ? 0 : static_cast<std::uint32_t>(sink.used());
  std::memcpy(space.data(), &record, sizeof record);
  const auto used = padded(sizeof record + record.payload_bytes);
  mine->ring->publish(used);
  prefetch_for_writing(space.data() + used);
  count(mine->recorded);
  if (record.oversize)
    count(mine->oversize);
  if (mine->ring->more_than_half_full() && !mine->woke_writer.load(std::memory_order_relaxed)) {
    mine->woke_writer.store(true, std::memory_order_relaxed);
    shared_->wake_writer();
  }
}

void ring_trace::close() { writer_->stop(); }

trace_counts ring_trace::counts() const {
  auto result = writer_->renderer().counts();
  result.dropped = shared_->dropped_without_ring.load();
  for (const auto* each : shared_->all_rings()) {
    result.recorded += each->recorded.load();
    result.dropped += each->dropped.load();
    result.oversize += each->oversize.load();
  }
  return result;
}

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
