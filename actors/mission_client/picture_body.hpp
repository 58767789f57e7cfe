// The picture that a call names, as a part of its body. Source: RFC 4648, section 4 (base64). Thread: any.
#pragma once

#include <filesystem>

#include "actors/mission_client/service_port.hpp"

namespace godwit::mission_client {

// The empty `jpeg` with which CALL's body ends becomes the file of FOLDER that is named in it, in base64. False: there
// is no such file, and the body stays as it is.
[[nodiscard]] bool put_picture(service_call& call, const std::filesystem::path& folder);

} // namespace godwit::mission_client
