#pragma once

#include "runtime/foveation/log_polar/map_tables.h"
#include "runtime/vulkan/memory.h"

namespace gazeloop::render {

/// A map's tables on the GPU, in its own memory, because every fragment reads them; as
/// shaders/lib/log_polar.glsl binds them. No gaze changes them.
class MapBuffers {
  public:
    /// For `samples` per cell of an LP-buffer with `rows` rows.
    MapBuffers(const vulkan::Context& context, const foveation::MapTables& tables,
               std::uint32_t samples, std::uint32_t rows);

    [[nodiscard]] vk::Buffer map_tables() const { return map_tables_.buffer(); }
    [[nodiscard]] vk::Buffer column_table() const { return column_table_.buffer(); }
    [[nodiscard]] vk::Buffer row_table() const { return row_table_.buffer(); }

  private:
    vulkan::DeviceBuffer map_tables_;
    vulkan::DeviceBuffer column_table_;
    vulkan::DeviceBuffer row_table_;
};

}  // namespace gazeloop::render
