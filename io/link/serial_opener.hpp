// serial:///dev/NAME:BAUD for stream_link. Opening takes no time to speak of and is done at once.
#pragma once

#include "io/link/stream_opener.hpp"
#include "io/link/uri.hpp"

namespace godwit::io::link {

class serial_opener final : public stream_opener {
public:
  explicit serial_opener(const uri& where) : device_(where.device), baud_(where.baud) {}

  void open(std::function<void(result)> done) override;
  [[nodiscard]] ssize_t write(int stream, std::span<const std::byte> bytes) const override;
  void discard_output(int stream) const override;
  [[nodiscard]] std::string where() const override;
  [[nodiscard]] std::string why_it_ended(int error) const override;

private:
  std::string device_;
  std::uint32_t baud_;
};

} // namespace godwit::io::link
