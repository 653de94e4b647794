// Any bytes as one transfer of a PlayStation VR2: refused, or values that can be.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>

#include "drivers/psvr2/gaze_packet.h"

namespace {

using namespace gazeloop::drivers::psvr2;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void require_unit(const std::optional<glm::dvec3>& v) {
    require(!v || std::abs(glm::length(*v) - 1.0) < 1e-9);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto packet = decode_gaze_packet({data, size});
    if (!packet) {
        return 0;
    }
    require(size == kPacketBytes);
    for (const EyeBlock& eye : packet->eyes) {
        require_unit(eye.direction);
        require(!eye.origin_mm || glm::length(*eye.origin_mm) < 200.0);
        require(!eye.pupil_mm || (*eye.pupil_mm > 0.0 && *eye.pupil_mm <= 15.0));
    }
    return 0;
}
