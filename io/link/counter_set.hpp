// The counters of a link while they count: written by the link's thread and by senders, read by anybody.
//
// Thread: any; each counter for itself, so two that are read together may be one event apart.
#pragma once

#include <atomic>
#include <cstdint>

#include "io/link/link.hpp"

namespace godwit::io::link {

class counter {
public:
  void add(std::uint64_t n = 1) { value_.fetch_add(n, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t value() const { return value_.load(std::memory_order_relaxed); }

private:
  std::atomic<std::uint64_t> value_{0};
};

struct counter_set {
  counter rx_bytes, rx_chunks, tx_bytes, tx_chunks, tx_dropped, tx_no_peer, open_failures, losses, errors;

  void received(std::uint64_t bytes) {
    rx_bytes.add(bytes);
    rx_chunks.add();
  }
  void sent(std::uint64_t bytes) {
    tx_bytes.add(bytes);
    tx_chunks.add();
  }
  // Queue and peers are the link's own business.
  [[nodiscard]] link_counters values() const {
    link_counters all;
    all.rx_bytes = rx_bytes.value();
    all.rx_chunks = rx_chunks.value();
    all.tx_bytes = tx_bytes.value();
    all.tx_chunks = tx_chunks.value();
    all.tx_dropped = tx_dropped.value();
    all.tx_no_peer = tx_no_peer.value();
    all.open_failures = open_failures.value();
    all.losses = losses.value();
    all.errors = errors.value();
    return all;
  }
};

} // namespace godwit::io::link
