// Where the operator's port is, and by what its certificate is known: set when it opens, shown in the status.
//
// Thread: any.
#pragma once

#include <mutex>
#include <string>

#include <nlohmann/json.hpp>

namespace godwit::control {

class port_view {
public:
  void set(std::string url, std::string fingerprint) {
    const std::lock_guard guard(mutex_);
    url_ = std::move(url);
    fingerprint_ = std::move(fingerprint);
  }
  // Null: it is not open.
  [[nodiscard]] nlohmann::json json() const {
    const std::lock_guard guard(mutex_);
    if (url_.empty())
      return nullptr;
    return {{"url", url_}, {"fingerprint", fingerprint_}};
  }

private:
  mutable std::mutex mutex_; // over what stands below
  std::string url_;
  std::string fingerprint_; // empty without TLS
};

} // namespace godwit::control
