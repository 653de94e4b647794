#include "runtime/report/percentiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gazeloop::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Percentiles, AreFiveUnlessOthersAreAskedFor) {
    EXPECT_THAT(Percentiles{}.names(), ElementsAre("p50", "p90", "p95", "p99", "p99.9"));
}

TEST(Percentiles, AreReadAsTheyAreNamed) {
    const auto percentiles = Percentiles::parse("0.5,50,99.95");
    ASSERT_TRUE(percentiles);
    EXPECT_THAT(percentiles->percents(), ElementsAre(0.5, 50.0, 99.95));
    EXPECT_THAT(percentiles->names(), ElementsAre("p0.5", "p50", "p99.95"));
}

TEST(Percentiles, AreRefusedWithThePlace) {
    struct Refused {
        std::string text;
        std::string because;
    };
    const std::vector<Refused> all{
        {"", "number 1, '', is no number"},
        {"50,", "number 2, '', is no number"},
        {"50,x", "number 2, 'x', is no number"},
        {"50,95%", "number 2, '95%', is no number"},
        {" 50", "number 1, ' 50', is no number"},
        {"nan", "number 1, 'nan', is no percentile"},
        {"inf", "number 1, 'inf', is no percentile"},
        {"1e999", "is no number"},
        {"0,50", "number 1, '0', is no percentile"},
        {"50,100", "number 2, '100', is no percentile"},
        {"-5", "number 1, '-5', is no percentile"},
        {"50,50", "number 2, '50', is not above the one before"},
        {"95,50", "number 2, '50', is not above the one before"},
        {"1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21", "there are more than 20"}};
    for (const Refused& one : all) {
        const auto percentiles = Percentiles::parse(one.text);
        ASSERT_FALSE(percentiles) << one.text;
        EXPECT_EQ(percentiles.error().kind, ErrorKind::Usage);
        EXPECT_THAT(percentiles.error().message, HasSubstr(one.because));
        EXPECT_THAT(percentiles.error().message, HasSubstr("--percentiles 50,95,99.9"));
    }
}

}  // namespace
}  // namespace gazeloop::report
