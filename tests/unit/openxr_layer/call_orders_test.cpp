// Sequences of calls in any order, many: GAZELOOP_CALL_ORDERS says how many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

#include "tests/unit/openxr_layer/any_call.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

/// In a few seconds, under sanitizers too.
constexpr std::uint64_t kUsualOrders = 20'000;

std::uint64_t wanted_orders() {
    const char* const text = std::getenv("GAZELOOP_CALL_ORDERS");
    return text != nullptr ? std::strtoull(text, nullptr, 10) : kUsualOrders;
}

/// Each sequence has a session of its own; an instance serves a thousand, with other settings than
/// the one before. A sequence that fails is found again by its number.
TEST(CallOrders, DoNoHarm) {
    const Home home;
    const std::array<std::string, 5> settings{
        "layer.gaze=fixed:1,2", "layer.gaze=sim", "",
        "layer.gaze=fixed:0,0\nlayer.unknown_applications=foveation",
        "layer.gaze=fixed:0,0\nlayer.eye_gaze=always"};
    constexpr std::uint64_t kOrdersOfInstance = 1'000;
    const std::uint64_t orders = wanted_orders();
    for (std::uint64_t first = 0; first < orders; first += kOrdersOfInstance) {
        set_settings(settings[first / kOrdersOfInstance % settings.size()]);
        MockApplication application(every_extension());
        for (std::uint64_t order = first; order < std::min(first + kOrdersOfInstance, orders);
             ++order) {
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
    }
}

}  // namespace
}  // namespace gazeloop::openxr_layer
