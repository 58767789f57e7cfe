// Gives an answer to an HTTP server as its faults want it: late, slowly, cut off, much longer than it should be, or not
// at all. Here, so that the server itself has no faults to ask for.
//
// Thread: that of the context.
#pragma once

#include <boost/asio/io_context.hpp>

#include "io/http/server/responder.hpp"
#include "programs/godwit-sim/missions/delivery.hpp"

namespace godwit::sim::missions {

void deliver(boost::asio::io_context& io, io::http::responder to, delivery what);

} // namespace godwit::sim::missions
