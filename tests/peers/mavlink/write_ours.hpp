// Writes frames of all our messages for the peer to read, unsigned and signed, and beside them what it must find.
#pragma once

#include <cstdint>
#include <filesystem>

namespace godwit::io::mavlink::peers {

// FOLDER/frames.bin, FOLDER/frames.jsonl with one description a line, and FOLDER/changed.jsonl, where one field has
// another value: held against that the check must fail. Errors: a file that can not be written throws.
void write_ours(const std::filesystem::path& folder, std::uint64_t seed);

} // namespace godwit::io::mavlink::peers
