#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/light_field/lens.h"
#include "runtime/scene/light_field_memory.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::scene {

/// The settings lightfield.*
struct LightFieldSettings {
    double focus_m = 2.0;
    double aperture_m = 0.01;
    std::int64_t memory_mib = 1024;
    std::string compression = "none";
    bool prefetch = true;

    [[nodiscard]] light_field::Lens lens() const {
        return {.focus_m = focus_m, .aperture_m = aperture_m};
    }

    [[nodiscard]] LightFieldMemory memory() const {
        return {.most_bytes = static_cast<std::uint64_t>(memory_mib) << 20U,
                .compressed = compression == "bc1",
                .fetch_ahead = prefetch};
    }

    friend bool operator==(const LightFieldSettings&, const LightFieldSettings&) = default;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(LightFieldSettings& light_field);

}  // namespace gazeloop::scene
