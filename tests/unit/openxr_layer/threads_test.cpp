// An application whose threads share a session, as engines do.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "runtime/session/session_file.h"
#include "tests/unit/openxr_layer/gaze_reader.h"
#include "tests/unit/openxr_layer/mock_application.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

/// One draws and ends frames, one synchronizes actions, two locate the gaze, and one makes and ends
/// an instance with a session again and again. Meant for ThreadSanitizer too.
TEST(LayerThreads, ShareASession) {
    const Home home;
    const std::string file = home.folder.path() / "session.gaze";
    set_settings("layer.gaze=sim\nlayer.record=" + file);
    constexpr int kFrames = 300;
    {
        MockApplication application;
        make_gaze_reader(application);
        std::atomic<bool> over{false};
        std::atomic<int> failed{0};
        const auto until_over = [&over](auto call) {
            return std::jthread([&over, call] {
                while (!over) {
                    call();
                }
            });
        };
        const auto locate = [&] {
            XrResult result = XR_SUCCESS;
            application.locate(application.spaces[0], application.spaces[2], MockRuntime::now(),
                               result);
            failed += result != XR_SUCCESS ? 1 : 0;
        };
        std::vector<std::jthread> threads;
        threads.push_back(until_over([&] { failed += application.sync() != XR_SUCCESS ? 1 : 0; }));
        threads.push_back(until_over(locate));
        threads.push_back(until_over(locate));
        threads.push_back(until_over([&] {
            MockApplication other;
            failed += other.make_session() != XR_SUCCESS ? 1 : 0;
        }));
        for (int frame = 0; frame < kFrames; ++frame) {
            application.frame(application.spaces[2]);
        }
        over = true;
        threads.clear();
        EXPECT_EQ(failed, 0);
        application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
    }
    const session::SessionFile session = value_or_throw(session::read_session(file));
    EXPECT_EQ(session.frames.size() + session.records_dropped, kFrames);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
