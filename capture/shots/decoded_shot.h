// Decoded shots as bytes, for a cache.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/observed_shot.h"

namespace scattermeter::capture {

// As CBOR (RFC 8949), numbers bit by bit.
std::vector<std::uint8_t> to_bytes(const DecodedShot& shot);
// Empty for bytes that are no shot: cut short, of another kind, lists of different length.
std::optional<DecodedShot> decoded_shot(std::span<const std::uint8_t> bytes);

}  // namespace scattermeter::capture
