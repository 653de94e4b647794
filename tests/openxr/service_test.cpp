// A runtime that is a process of its own: it may not be there, and it may go away.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "runtime/session/session_file.h"
#include "tests/openxr/monado_service.h"

namespace gazeloop::tests {
namespace {

class Service : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(MonadoService::folder())
            << "no Monado service in the cache folder: ./dev test builds it";
    }

    /// Records frames until the service is ended in this way.
    void lose_the_service(const std::function<void(BackgroundProcess&)>& end_service) {
        MonadoService service(scratch_, {{"XRT_COMPOSITOR_NULL", "1"}});
        ASSERT_TRUE(service.ready()) << service.process().output();
        const ProgramResult result =
            run_gazeloop({"run", "--gaze", "fixed:2,1", "--seconds", "60", "--record", session(),
                          "--hash", "--set", "render.scale=0.1", "--log-level", "debug"},
                         {.environment = MonadoService::client_environment(scratch_),
                          .trigger = "session state: FOCUSED",
                          .on_trigger = [&](int) {
                              wait_for_frames();
                              end_service(service.process());
                          }});
        EXPECT_EQ(result.exit_code, 5) << result.err;
        EXPECT_NE(result.err.find("the runtime or its session went away"), std::string::npos)
            << result.err;
        EXPECT_NE(result.out.find("gaze age at display"), std::string::npos) << result.out;
        check_recording();
    }

    /// A session can be read while it is written.
    void wait_for_frames() const {
        constexpr std::size_t kEnough = 12;
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (std::chrono::steady_clock::now() < deadline) {
            const auto recorded = session::read_session(session());
            if (recorded && recorded->frames.size() >= kEnough) {
                return;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }

    /// Closed, with every frame up to the loss, the GPU's part too, and why it ended.
    void check_recording() const {
        const auto recorded = session::read_session(session());
        ASSERT_TRUE(recorded.has_value()) << recorded.error().message;
        EXPECT_TRUE(recorded->closed_cleanly);
        EXPECT_EQ(recorded->records_dropped, 0U);
        ASSERT_GE(recorded->frames.size(), 12U);
        for (std::size_t i = 0; i < recorded->frames.size(); ++i) {
            EXPECT_EQ(recorded->frames[i].frame.index, i);
            if (recorded->frames[i].frame.should_render) {
                EXPECT_TRUE(recorded->frames[i].gpu.pixel_hash.has_value()) << i;
            }
        }
        // The frame during which the runtime went away may have taken its gaze already.
        EXPECT_GE(recorded->samples.size(), recorded->frames.size());
        EXPECT_LE(recorded->samples.size(), recorded->frames.size() + 1);
        ASSERT_FALSE(recorded->events.empty());
        EXPECT_EQ(recorded->events.back().kind, "error");
        EXPECT_NE(recorded->events.back().text.find("session went away"), std::string::npos);

        const std::string frames = "frames   " + std::to_string(recorded->frames.size());
        const ProgramResult report = run_gazeloop({"report", session()});
        EXPECT_EQ(report.exit_code, 0) << report.err;
        EXPECT_NE(report.out.find(frames), std::string::npos) << report.out;
        const ProgramResult replay = run_gazeloop({"replay", session(), "--hash"});
        EXPECT_EQ(replay.exit_code, 0) << replay.err << replay.out;
    }

    [[nodiscard]] std::string session() const { return scratch_.file("session.gaze"); }

    ScratchFolder scratch_;
};

TEST_F(Service, IsMissedBeforeTheFirstFrame) {
    const ProgramResult result =
        run_gazeloop({"run", "--frames", "5", "--record", session()},
                     {.environment = MonadoService::client_environment(scratch_)});
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find("did not start"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("is its service running"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(session()));
    const ProgramResult doctor =
        run_gazeloop({"doctor"}, {.environment = MonadoService::client_environment(scratch_)});
    EXPECT_EQ(doctor.exit_code, 4) << doctor.err;
    EXPECT_NE(doctor.out.find("-> start the runtime's service"), std::string::npos) << doctor.out;
}

TEST_F(Service, ServesAWholeRun) {
    const MonadoService service(scratch_, {{"XRT_COMPOSITOR_NULL", "1"}});
    ASSERT_TRUE(service.ready());
    for (int run = 0; run < 2; ++run) {  // the second one finds it as the first one left it
        const ProgramResult result =
            run_gazeloop({"run", "--frames", "10", "--set", "render.scale=0.1", "--set",
                          "vulkan.validation=true"},
                         {.environment = MonadoService::client_environment(scratch_)});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err.find("Vulkan validation"), std::string::npos) << result.err;
    }
}

TEST_F(Service, KilledEndsTheRunAndLosesNothingRecorded) {
    lose_the_service([](BackgroundProcess& service) { service.signal(SIGKILL); });
}

TEST_F(Service, ThatQuitsEndsTheRunAsWell) {
    lose_the_service([](BackgroundProcess& service) {
        service.write("quit\n");
        EXPECT_EQ(service.wait(std::chrono::seconds(30)), 0) << service.output();
    });
}

TEST_F(Service, SaysWhatBecameOfEachFrame) {
    const std::string metrics = scratch_.file("metrics.pb");
    {
        MonadoService service(scratch_,
                              {{"XRT_COMPOSITOR_NULL", "1"}, {"XRT_METRICS_FILE", metrics}});
        ASSERT_TRUE(service.ready()) << service.process().output();
        Environment environment = MonadoService::client_environment(scratch_);
        environment.emplace_back("XRT_METRICS_FILE", metrics);
        const ProgramResult run = run_gazeloop({"run", "--gaze", "fixed:2,1", "--frames", "60",
                                                "--record", session(), "--set", "render.scale=0.1"},
                                               {.environment = environment});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        service.process().write("quit\n");  // it then writes what it still holds
        EXPECT_EQ(service.process().wait(std::chrono::seconds(30)), 0);
    }
    const ProgramResult report = run_gazeloop({"report", session(), "--json", "-"});
    ASSERT_EQ(report.exit_code, 0) << report.err;
    const nlohmann::json json = nlohmann::json::parse(report.out);
    const nlohmann::json& told = json["runtime_metrics"];
    EXPECT_EQ(told["file"], metrics) << "the session says where it is";
    EXPECT_EQ(told["version"], "1.1");
    const nlohmann::json& frames = told["frames"];
    EXPECT_EQ(frames["rendered"], json["frames"]["rendered"]);
    EXPECT_EQ(frames["missing"], 0) << "both have the same display times, to the nanosecond";
    EXPECT_EQ(frames["untimed"], 0);
    EXPECT_EQ(frames["presented"], 0) << "no display, so nothing is measured";
    EXPECT_GT(frames["joined"], 0) << "how many, the machine's load decides";
    EXPECT_EQ(frames["joined"], frames["modelled"]);
    EXPECT_EQ(frames["joined"].get<int>() + frames["replaced"].get<int>() +
                  frames["not_taken"].get<int>() + frames["discarded"].get<int>() +
                  frames["not_announced"].get<int>(),
              frames["rendered"]);
    EXPECT_EQ(told["records"]["cut_at_byte"], nullptr);
    EXPECT_EQ(told["records"]["damaged"], 0);
    EXPECT_EQ(json["durations"]["stage_compositor"]["frames_by_kind"]["modelled"],
              frames["joined"]);
    EXPECT_EQ(json["durations"]["stage_wait_for_display"]["frames_by_kind"]["modelled"],
              frames["joined"]);

    const ProgramResult text = run_gazeloop({"report", session(), "--runtime-metrics", metrics});
    EXPECT_NE(text.out.find("rendered frames joined with Monado's metrics"), std::string::npos);
    EXPECT_NE(text.out.find("Monado's model of a display"), std::string::npos) << text.out;
    const ProgramResult wrong = run_gazeloop({"report", session(), "--runtime-metrics", session()});
    EXPECT_EQ(wrong.exit_code, 3);
    EXPECT_NE(wrong.err.find("no metrics file of Monado"), std::string::npos) << wrong.err;
}

TEST_F(Service, AloneWritesMetrics) {
    const ProgramResult run =
        run_gazeloop({"run", "--frames", "3", "--record", session(), "--set", "render.scale=0.1"},
                     {.environment = {{"XRT_METRICS_FILE", scratch_.file("metrics.pb")}}});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const ProgramResult report = run_gazeloop({"report", session()});
    EXPECT_EQ(report.exit_code, 0);
    EXPECT_NE(report.out.find("XRT_METRICS_FILE was set in this run, but no metrics were read"),
              std::string::npos)
        << report.out;
    EXPECT_NE(report.out.find("Only monado-service writes them"), std::string::npos);
}

}  // namespace
}  // namespace gazeloop::tests
