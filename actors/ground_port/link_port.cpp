#include "actors/ground_port/link_port.hpp"

#include <memory>
#include <utility>

namespace godwit::ground_port {

tl::expected<void, std::string> link_port::open(const io::link::uri& where, const io::link::link_options& options,
                                                runtime::gateway gateway, wake_handle actor) {
  // Both callbacks of a link come in its one thread, and so share one gateway.
  const auto way_in = std::make_shared<runtime::gateway>(std::move(gateway));
  return line::open(where, options, [way_in, actor = std::move(actor)] { way_in->tell(actor, wake{}); });
}

} // namespace godwit::ground_port
