#include "runtime/render/kfr_eye.h"

#include <array>
#include <glm/vec4.hpp>

#include "runtime/error.h"
#include "runtime/foveation/map_tables.h"

namespace gazeloop::render {
namespace {

constexpr std::size_t kMantissaVectors = foveation::MapTables::kMantissaSteps / 4 + 1;
constexpr std::size_t kKernelVectors = foveation::MapTables::kKernelSteps / 4 + 1;

/// std140, four entries a vector: shaders/lib/log_polar.glsl.
struct PackedTables {
    std::array<glm::vec4, kMantissaVectors> log2_mantissa;
    std::array<glm::vec4, kMantissaVectors> exp2_fraction;
    std::array<glm::vec4, kKernelVectors> kernel;
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

KfrEye::KfrEye(const VulkanContext& context, const foveation::KfrParameters& parameters,
               foveation::ImageSize image)
    : parameters_(parameters),
      image_(image),
      lp_(value_or_throw(foveation::lp_buffer_size(parameters, image))),
      lp_buffer_(context, vk::Extent2D(lp_.width, lp_.height), kLpFormat,
                 vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled |
                     vk::ImageUsageFlagBits::eTransferSrc),
      direct_buffer_(context, vk::Extent2D(image.width_px, image.height_px), kLpFormat,
                     vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled) {
    const foveation::MapTables tables = foveation::build_map_tables(parameters.kernel, lp_);
    PackedTables packed;
    pack(packed.log2_mantissa, tables.log2_mantissa);
    pack(packed.exp2_fraction, tables.exp2_fraction);
    pack(packed.kernel, tables.kernel);
    map_tables_ = HostBuffer(context, sizeof packed, vk::BufferUsageFlagBits::eUniformBuffer);
    map_tables_.write(packed);
    const std::span<const float> columns(tables.column);
    column_table_ =
        HostBuffer(context, columns.size_bytes(), vk::BufferUsageFlagBits::eStorageBuffer);
    column_table_.write(columns);
    const std::span<const foveation::MapTables::Direction> rows(tables.row);
    row_table_ = HostBuffer(context, rows.size_bytes(), vk::BufferUsageFlagBits::eStorageBuffer);
    row_table_.write(rows);
}

std::size_t KfrEye::max_bands() const {
    return std::size_t{lp_.height / foveation::kBandRows} +
           image_.height_px / foveation::kBandRows + 2;
}

}  // namespace gazeloop::render
