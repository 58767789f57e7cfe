// Reads the audit in the journal's file, beside its writer: a page takes a read of the disk, and no actor waits for it.
//
// What waits when it is destroyed hears nothing. Thread: read by any; THEN in its own.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>

#include <boost/asio/thread_pool.hpp>
#include <tl/expected.hpp>

#include "messages/operator_bridge/audit.hpp"

namespace godwit {

// Where the rows of the audit are read, for those who show them. Thread: any; THEN in any, at once or later, once.
using audit_page_or_why = tl::expected<operator_bridge::audit_page, std::string>; // why not: a sentence for people
using audit_source =
    std::function<void(const operator_bridge::audit_query& wanted, std::function<void(const audit_page_or_why&)> then)>;

} // namespace godwit

namespace godwit::daemon {

class audit_reader {
public:
  static constexpr std::size_t max_waiting = 16;

  explicit audit_reader(std::string journal) : journal_(std::move(journal)) {}
  audit_reader(const audit_reader&) = delete;
  audit_reader& operator=(const audit_reader&) = delete;
  ~audit_reader();

  void read(const operator_bridge::audit_query& wanted, std::function<void(const audit_page_or_why&)> then);

private:
  const std::string journal_;
  std::atomic<std::size_t> waiting_{0};
  boost::asio::thread_pool thread_{1};
};

} // namespace godwit::daemon
