// TLS as this service speaks it: 1.2 or newer, with its own certificate, and without asking for the client's.
//
// Errors: a sentence for people. Thread: a context is made by one thread and used by one.
#pragma once

#include <memory>
#include <string>

#include <boost/asio/ssl/context.hpp>
#include <tl/expected.hpp>

#include "programs/godwit-sim/missions/settings.hpp"

namespace godwit::sim::missions {

[[nodiscard]] tl::expected<std::unique_ptr<boost::asio::ssl::context>, std::string> tls_server(const identity& who);

} // namespace godwit::sim::missions
