// Joins a link to the actor: what comes in is queued, and the actor is woken when it has nothing left to do.
//
//   auto port = std::make_shared<link_port>();
//   auto ground = actors.add<ground_port::actor>({.name = "ground_port"}, policy, settings, signing, port, others);
//   actors.start();
//   if (auto opened = port->open(where, options, actors.make_gateway("ground_line"), ground); !opened) ...
//
// It outlives the incarnations of the actor, so that a crash of the actor closes no line. Close it before the actors
// are stopped. Thread: open and close by the owner; the rest from any.
#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/link/line.hpp"
#include "messages/ground_port/handle.hpp"
#include "runtime/gateway.hpp"

namespace godwit::ground_port {

class link_port final : public io::link::line {
public:
  // The error is that of io::link::open_link.
  [[nodiscard]] tl::expected<void, std::string> open(const io::link::uri& where, const io::link::link_options& options,
                                                     runtime::gateway gateway, wake_handle actor);
};

} // namespace godwit::ground_port
