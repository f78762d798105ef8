// Serialisation of decoded shots, for a cache.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/observed_shot.h"

namespace scattermeter::capture {

// The shot as CBOR (RFC 8949); the bits of all numbers are preserved.
std::vector<std::uint8_t> to_bytes(const DecodedShot& shot);
// nullopt for bytes that are not a valid shot: truncated, of another kind, or with lists of
// different lengths.
std::optional<DecodedShot> decoded_shot(std::span<const std::uint8_t> bytes);

}  // namespace scattermeter::capture
