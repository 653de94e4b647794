#include "runtime/render/map_buffers.h"

#include <array>
#include <glm/vec4.hpp>

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

MapBuffers::MapBuffers(const vulkan::Context& context, const MapTables& tables) {
    PackedTables packed;
    pack(packed.log2_mantissa, tables.log2_mantissa);
    pack(packed.exp2_fraction, tables.exp2_fraction);
    pack(packed.forward, tables.forward);
    map_tables_ =
        vulkan::HostBuffer(context, sizeof packed, vk::BufferUsageFlagBits::eUniformBuffer);
    map_tables_.write(packed);
    const std::span<const float> columns(tables.column);
    column_table_ =
        vulkan::HostBuffer(context, columns.size_bytes(), vk::BufferUsageFlagBits::eStorageBuffer);
    column_table_.write(columns);
    const std::span<const MapTables::Direction> rows(tables.row);
    row_table_ =
        vulkan::HostBuffer(context, rows.size_bytes(), vk::BufferUsageFlagBits::eStorageBuffer);
    row_table_.write(rows);
}

}  // namespace gazeloop::render
