#include "runtime/governor/level_account.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gazeloop::governor {
namespace {

using testing::HasSubstr;

const Front kFront{.figure = "contrast",
                   .levels = {{.method = "full", .ms = 40.0, .loss = 0.25},
                              {.method = "kfr", .ms = 12.5, .loss = 1.0}}};

void tell(LevelAccount& account, std::uint64_t index, std::optional<std::uint64_t> level,
          std::optional<std::int64_t> took_ns) {
    frame::FrameRecord record;
    record.index = index;
    record.period_ns = 10'000'000;
    record.quality_level = level;
    account.on_frame(record);
    frame::FrameGpuRecord gpu;
    gpu.index = index;
    if (took_ns) {
        gpu.gpu_begin = {5, time::StampKind::Measured};
        gpu.gpu_end = {5 + *took_ns, time::StampKind::Measured};
    }
    account.on_gpu(gpu);
}

TEST(LevelAccount, CountsLevelsChangesAndWhatKeptThePeriod) {
    LevelAccount account(kFront);
    for (std::uint64_t frame = 0; frame < 4; ++frame) {
        tell(account, frame, 0, 20'000'000);
    }
    for (std::uint64_t frame = 4; frame < 16; ++frame) {
        tell(account, frame, 1, 10'000'000);
    }
    EXPECT_EQ(account.text(),
              "the governor held level 2 of 2: kfr (contrast 1 where its front was measured), in "
              "75.0 % of frames; 1 change; 75.0 % of frames took no longer than the display's "
              "period\n");
    const nlohmann::ordered_json json = account.json();
    EXPECT_EQ(json.at("changes"), 1);
    EXPECT_EQ(json.at("levels")[0].at("within_period"), 0);
    EXPECT_EQ(json.at("levels")[1].at("frames"), 12);
    EXPECT_EQ(json.at("levels")[1].at("within_period"), 12);
}

TEST(LevelAccount, SaysWhatIsUnknown) {
    LevelAccount account(kFront);
    EXPECT_THAT(account.text(), HasSubstr("drew nothing"));
    tell(account, 0, std::nullopt, 1);
    tell(account, 1, 7, 1);  // no level of this front
    EXPECT_THAT(account.text(), HasSubstr("drew nothing"));
    tell(account, 2, 0, std::nullopt);
    EXPECT_THAT(account.text(), HasSubstr("how long frames took is unknown"));
    EXPECT_TRUE(account.json().at("levels")[0].at("within_period").is_null());
    EXPECT_EQ(account.json().at("changes"), 0);
}

}  // namespace
}  // namespace gazeloop::governor
