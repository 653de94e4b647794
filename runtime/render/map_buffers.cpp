#include "runtime/render/map_buffers.h"

#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <numbers>
#include <span>

#include "runtime/render/frame_uniforms.h"

namespace gazeloop::render {
namespace {

using foveation::MapTables;

constexpr std::size_t kMantissaVectors = MapTables::kMantissaSteps / 4 + 1;
constexpr std::size_t kForwardVectors = MapTables::kForwardSteps / 4 + 1;

/// std140, four entries a vector: shaders/lib/log_polar.glsl.
struct PackedTables {
    std::array<glm::vec4, kMantissaVectors> log2_mantissa;
    std::array<glm::vec4, kMantissaVectors> exp2_fraction;
    std::array<glm::vec4, kForwardVectors> forward;
    std::array<glm::vec4, kMaxSamples> turns;
};

template <std::size_t Vectors, std::size_t Entries>
void pack(std::array<glm::vec4, Vectors>& packed, const std::array<float, Entries>& entries) {
    static_assert(Vectors * 4 >= Entries);
    packed.fill(glm::vec4(0.0F));
    for (std::size_t i = 0; i < Entries; ++i) {
        packed[i / 4][static_cast<glm::length_t>(i % 4)] = entries[i];
    }
}

}  // namespace

MapBuffers::MapBuffers(const vulkan::Context& context, const MapTables& tables,
                       std::uint32_t samples, std::uint32_t rows) {
    PackedTables packed{};
    pack(packed.log2_mantissa, tables.log2_mantissa);
    pack(packed.exp2_fraction, tables.exp2_fraction);
    pack(packed.forward, tables.forward);
    const double row_angle = 2.0 * std::numbers::pi / rows;
    const auto offsets = sample_offsets(samples);
    for (std::size_t s = 0; s < samples; ++s) {
        const double angle = offsets[s].y * row_angle;
        packed.turns[s] = glm::vec4(glm::dvec4(std::cos(angle), std::sin(angle), 0.0, 0.0));
    }
    using Usage = vk::BufferUsageFlagBits;
    map_tables_ = {context, std::as_bytes(std::span(&packed, 1)), Usage::eUniformBuffer};
    column_table_ = {context, std::as_bytes(std::span(tables.column)), Usage::eStorageBuffer};
    row_table_ = {context, std::as_bytes(std::span(tables.row)), Usage::eStorageBuffer};
}

}  // namespace gazeloop::render
