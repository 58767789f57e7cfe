// A token or a key in memory: wiped when it is no longer needed, never copied, and without a way into a log.
//
// Thread: as any value.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <openssl/crypto.h>

namespace godwit::io::http {

class secret_text {
public:
  secret_text() = default;
  explicit secret_text(std::size_t size) : text_(size, '\0') {}
  ~secret_text() { wipe(); }
  secret_text(const secret_text&) = delete;
  secret_text& operator=(const secret_text&) = delete;
  secret_text(secret_text&& other) noexcept : text_(std::move(other.text_)) { other.wipe(); }
  secret_text& operator=(secret_text&& other) noexcept {
    if (this != &other) {
      wipe();
      text_ = std::move(other.text_);
      other.wipe();
    }
    return *this;
  }

  [[nodiscard]] std::string_view revealed() const { return text_; }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] char* data() { return text_.data(); }
  // Only shorter: growing would leave a copy behind.
  void cut_to(std::size_t size) { text_.erase(size); }

private:
  // A short text lies within the object, and moving leaves it behind: so the whole room is wiped.
  void wipe() {
    text_.resize(text_.capacity());
    OPENSSL_cleanse(text_.data(), text_.size());
    text_.clear();
  }

  std::string text_;
};

} // namespace godwit::io::http
