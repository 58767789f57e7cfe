// Joins a line to the actor that has it: what comes in is queued, and the actor is woken when it has nothing left to
// do.
//
//   auto port = std::make_shared<link_port>();
//   auto link = actors.add<vehicle_link::actor>({.name = "vehicle_link"}, policy, settings, port, ...);
//   actors.start();
//   if (auto opened = port->open(where, options, actors.make_gateway("vehicle_port"), link); !opened) ...
//
// It outlives the incarnations of the actor, so that a crash of the actor closes no line. Close it before the actors
// are stopped. Thread: open and close by the owner; the rest from any.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <tl/expected.hpp>

#include "io/link/line.hpp"
#include "runtime/gateway.hpp"

namespace godwit::line {

// HANDLE is of an actor that takes WAKE.
template <class Handle, class Wake>
class line_port final : public io::link::line {
public:
  // The error is that of io::link::open_link.
  [[nodiscard]] tl::expected<void, std::string> open(const io::link::uri& where, const io::link::link_options& options,
                                                     runtime::gateway gateway, Handle actor) {
    // Both callbacks of a link come in its one thread, and so share one gateway.
    const auto way_in = std::make_shared<runtime::gateway>(std::move(gateway));
    return io::link::line::open(where, options, [way_in, actor = std::move(actor)] { way_in->tell(actor, Wake{}); });
  }
};

} // namespace godwit::line
