#pragma once

#include "runtime/foveation/map_tables.h"
#include "runtime/render/gpu_memory.h"

namespace gazeloop::render {

/// A map's tables on the GPU, as shaders/lib/log_polar.glsl binds them. No gaze changes them.
class MapBuffers {
  public:
    MapBuffers(const VulkanContext& context, const foveation::MapTables& tables);

    [[nodiscard]] vk::Buffer map_tables() const { return map_tables_.buffer(); }
    [[nodiscard]] vk::Buffer column_table() const { return column_table_.buffer(); }
    [[nodiscard]] vk::Buffer row_table() const { return row_table_.buffer(); }

  private:
    HostBuffer map_tables_;
    HostBuffer column_table_;
    HostBuffer row_table_;
};

}  // namespace gazeloop::render
