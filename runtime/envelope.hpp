// The one concrete message that travels between actors: header, type and body.
//
// A body that is small and trivially copyable lies inside the envelope; any other is shared and constant, so that
// putting a message back, tracing it and telling it to several receivers copy no content. Thread: plain values; a
// shared body is never written again.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "runtime/assert.hpp"
#include "runtime/header.hpp"
#include "runtime/message_type.hpp"

namespace godwit::runtime {

class message_body {
public:
  static constexpr std::size_t inline_bytes = 64; // most of what a vehicle says many times a second

  template <class T>
  static constexpr bool is_inline = std::is_trivially_copyable_v<T> && sizeof(T) <= inline_bytes &&
                                    alignof(T) <= alignof(std::int64_t);

  message_body() = default;

  template <class T>
  [[nodiscard]] static message_body of(T value) {
    message_body result;
    if constexpr (is_inline<T>)
      ::new (static_cast<void*>(result.small_)) T(std::move(value));
    else
      result.large_ = std::make_shared<const T>(std::move(value));
    return result;
  }

  [[nodiscard]] const void* data() const noexcept { return large_ ? large_.get() : static_cast<const void*>(small_); }

private:
  std::shared_ptr<const void> large_;
  alignas(std::int64_t) std::byte small_[inline_bytes] = {};
};

struct envelope {
  header head;
  const message_type* type = nullptr;
  message_body body;

  template <class T>
  [[nodiscard]] static envelope of(const header& head, T value) {
    return {head, &type_of<T>(), message_body::of(std::move(value))};
  }

  template <class T>
  [[nodiscard]] bool is() const {
    return type == &type_of<T>();
  }

  template <class T>
  [[nodiscard]] const T& as() const {
    GODWIT_ASSERT(is<T>(), "an envelope is opened as the type that it was closed with");
    return *static_cast<const T*>(body.data());
  }
};

} // namespace godwit::runtime
