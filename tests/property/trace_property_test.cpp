#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <sstream>
#include <string>

#include "drivers/trace/native_trace.h"
#include "drivers/trace/read_trace.h"
#include "sim/gaze_generator.h"

namespace gazeloop::drivers {
namespace {

std::string generated_text(std::uint64_t seed) {
    std::ostringstream out;
    write_native_trace(sim::generate_gaze({.seed = seed}, 0.5), out);
    return out.str();
}

std::string htc_text() {
    return "time(100ns);eye_valid_L;eye_valid_R;openness_L;openness_R;gaze_origin_L.x(mm);"
           "gaze_origin_L.y(mm);gaze_origin_L.z(mm);gaze_origin_R.x(mm);gaze_origin_R.y(mm);"
           "gaze_origin_R.z(mm);gaze_direct_L.x;gaze_direct_L.y;gaze_direct_L.z;gaze_direct_R.x;"
           "gaze_direct_R.y;gaze_direct_R.z;helmet_pos_x;helmet_pos_y;helmet_pos_z;helmet_rot_x;"
           "helmet_rot_y;helmet_rot_z\r\n"
           "638342794000115346;31;31;.9;.9;39;2;-38;-31;1;-36;.12;-.12;.98;.12;-.12;.98;1;1;0;5;"
           "356;3\r\n"
           "638342794000195116;31;8;.9;.9;39;2;-38;-31;1;-36;.12;-.12;.98;0;0;0;1;1;0;5;356;3\r\n";
}

RC_GTEST_PROP(NativeTrace, GivesGeneratedTracesBackUnchanged, (std::uint64_t seed)) {
    const std::string text = generated_text(seed);
    std::istringstream in(text);
    const Expected<gaze::GazeTrace> trace = read_trace(in, "generated");
    RC_ASSERT(trace.has_value());
    std::ostringstream again;
    write_native_trace(*trace, again);
    RC_ASSERT(again.str() == text);
}

RC_GTEST_PROP(ReadTrace, KeepsItsPromisesForDamagedFiles, (std::uint64_t seed)) {
    std::string text = seed % 2 == 0 ? generated_text(seed) : htc_text();
    const int damages = *rc::gen::inRange(1, 6);
    const std::string likely = ",;.\n\r-+eE0123456789 naif\t";
    for (int i = 0; i < damages && !text.empty(); ++i) {
        const std::size_t at = *rc::gen::inRange<std::size_t>(0, text.size());
        const char c = *rc::gen::arbitrary<bool>() ? *rc::gen::elementOf(likely)
                                                   : static_cast<char>(*rc::gen::inRange(0, 256));
        switch (*rc::gen::inRange(0, 4)) {
            case 0:
                text[at] = c;
                break;
            case 1:
                text.insert(at, 1, c);
                break;
            case 2:
                text.erase(at, *rc::gen::inRange<std::size_t>(1, 200));
                break;
            default:
                text.resize(at);
                break;
        }
    }
    std::istringstream in(text);
    const Expected<gaze::GazeTrace> trace = read_trace(in, "damaged");
    if (!trace) {
        RC_ASSERT(trace.error().kind == ErrorKind::BadInput);
        RC_ASSERT(trace.error().message.find("damaged") != std::string::npos);
        return;
    }
    RC_ASSERT(!trace->samples.empty());
    RC_ASSERT(trace->samples.front().sampled.ns == 0);
    std::int64_t before_ns = -1;
    for (const gaze::GazeSample& sample : trace->samples) {
        RC_ASSERT(before_ns < sample.sampled.ns);
        before_ns = sample.sampled.ns;
        for (const gaze::EyeRay& ray : sample.eyes) {
            if (ray.valid) {
                RC_ASSERT(std::abs(glm::length(ray.direction) - 1.0) < 1e-8);
            }
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
