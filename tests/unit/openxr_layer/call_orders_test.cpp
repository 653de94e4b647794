// Sequences of calls in any order, many: GAZELOOP_CALL_ORDERS says how many.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <string>
#include <system_error>

#include "tests/unit/openxr_layer/any_call.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

/// In a few seconds, under sanitizers too.
constexpr std::uint64_t kUsualOrders = 20'000;

/// None: what the variable says is no number of sequences.
std::optional<std::uint64_t> wanted_orders() {
    const char* const text = std::getenv("GAZELOOP_CALL_ORDERS");
    if (text == nullptr) {
        return kUsualOrders;
    }
    std::uint64_t orders = 0;
    const char* const end = text + std::strlen(text);
    const auto [stop, error] = std::from_chars(text, end, orders);
    return error == std::errc{} && stop == end && orders > 0 ? std::optional(orders) : std::nullopt;
}

/// What instances are made with, in turns, and how many sequences each serves: a recording is a
/// file for each session.
struct Served {
    std::string settings;
    std::uint64_t orders = 1'000;
};

/// Each sequence has a session of its own; an instance serves many, with other settings than the
/// one before. A sequence that fails is found again by its number.
TEST(CallOrders, DoNoHarm) {
    const Home home;
    const std::filesystem::path sessions = home.folder.path() / "sessions";
    const std::string trace = home.folder.path() / "short.csv";
    std::ofstream(trace)
        << "time_s,left_azimuth_deg,left_elevation_deg\n0,1,2\n0.005,2,1\n0.01,3,0\n";
    const std::array<Served, 7> served{
        Served{"layer.gaze=fixed:1,2"}, Served{"layer.gaze=sim"}, Served{""},
        Served{"layer.gaze=fixed:0,0\nlayer.unknown_applications=foveation"},
        Served{"layer.gaze=fixed:0,0\nlayer.eye_gaze=always"},
        // One that ends and begins anew.
        Served{"layer.gaze=trace:" + trace},
        Served{"layer.gaze=sim\nlayer.record=" + sessions.string(), 5}};
    const auto wanted = wanted_orders();
    ASSERT_TRUE(wanted) << "GAZELOOP_CALL_ORDERS: a number of sequences is expected, e.g. 1000000";
    const std::uint64_t orders = *wanted;
    std::size_t turn = 0;
    for (std::uint64_t first = 0; first < orders;) {
        const Served& by = served[turn++ % served.size()];
        set_settings(by.settings);
        std::filesystem::remove_all(sessions);
        std::filesystem::create_directory(sessions);
        MockApplication application(every_extension());
        const std::uint64_t end = std::min(first + by.orders, orders);
        for (std::uint64_t order = first; order < end; ++order) {
            SCOPED_TRACE(order);
            std::mt19937_64 random(order);
            const auto pick = [&random](std::size_t many) {
                return static_cast<std::size_t>(random() % many);
            };
            application.forget();
            application.make_vulkan_session();
            const std::size_t calls = 1 + pick(40);
            for (std::size_t call = 0; call < calls; ++call) {
                ASSERT_NO_THROW(any_call(application, pick));
            }
            application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
        }
        ASSERT_FALSE(MockRuntime::the().saw_eyes());
        first = end;
    }
}

}  // namespace
}  // namespace gazeloop::openxr_layer
