#include "runtime/report/runtime_metrics/monado_metrics_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "tests/support/temporary_folder.h"
#include "tests/unit/report/runtime_metrics/monado_file.h"

namespace gazeloop::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t kGreatest = std::numeric_limits<std::int64_t>::max();

/// The only record behind the version.
template <typename Record>
Record only(const MonadoFile& file) {
    auto reader = value_or_throw(file.open());
    const auto record = reader.next();
    EXPECT_TRUE(record && std::holds_alternative<Record>(*record));
    EXPECT_FALSE(reader.next());
    return record && std::holds_alternative<Record>(*record) ? std::get<Record>(*record) : Record{};
}

std::string message(const std::string& bytes) {
    const auto reader = MonadoFile::open_bytes(bytes);
    return reader ? "" : reader.error().message;
}

TEST(MonadoMetrics, ReadsEachKindOfRecord) {
    MonadoFile session;
    session.session_frame({.session = 3,
                           .frame = 4,
                           .display_ns = kGreatest,
                           .begin_ns = 5,
                           .gpu_done_ns = 6,
                           .discarded = true});
    const auto frame = only<MonadoSessionFrame>(session);
    EXPECT_EQ(frame.session, 3);
    EXPECT_EQ(frame.frame, 4);
    EXPECT_EQ(frame.predicted_display_ns, kGreatest);
    EXPECT_EQ(frame.begin_ns, 5);
    EXPECT_EQ(frame.gpu_done_ns, 6);
    EXPECT_TRUE(frame.discarded);

    MonadoFile of_used;
    of_used.used(-1, 2, 3, 4);
    const auto used = only<MonadoUsed>(of_used);
    EXPECT_EQ(used.session, -1);
    EXPECT_EQ(used.session_frame, 2);
    EXPECT_EQ(used.system_frame, 3);
    EXPECT_EQ(used.when_ns, 4);

    MonadoFile of_system;
    of_system.system_frame(7, 9, 8);
    EXPECT_EQ(only<MonadoSystemFrame>(of_system).predicted_display_ns, 9);
    EXPECT_EQ(only<MonadoSystemFrame>(of_system).desired_present_ns, 8);

    MonadoFile of_gpu;
    of_gpu.gpu_info(7, 11, 12);
    EXPECT_EQ(only<MonadoGpuInfo>(of_gpu).gpu_end_ns, 11);

    MonadoFile of_present;
    of_present.present_info(
        {.frame = 7, .display_ns = 1, .desired_ns = 2, .actual_ns = 3, .when_ns = 4});
    const auto info = only<MonadoPresentInfo>(of_present);
    EXPECT_EQ(info.frame, 7);
    EXPECT_EQ(info.predicted_display_ns, 1);
    EXPECT_EQ(info.desired_present_ns, 2);
    EXPECT_EQ(info.actual_present_ns, 3);
    EXPECT_EQ(info.when_ns, 4);
}

TEST(MonadoMetrics, SkipsFieldsAndRecordsOfLaterVersions) {
    MonadoFile file(1, 9);
    std::string used;
    protozero::pbf_writer writer(used);
    {
        protozero::pbf_writer fields(writer, 3);
        fields.add_string(77, "more");
        fields.add_double(78, 0.5);
        fields.add_int64(2, 5);
    }
    file.raw(used);
    std::string later;
    protozero::pbf_writer(later).add_string(15, "a kind of a later version");
    file.raw(later);
    file.raw("");
    auto reader = value_or_throw(file.open());
    EXPECT_EQ(reader.version().minor, 9U);
    EXPECT_EQ(std::get<MonadoUsed>(reader.next().value()).session_frame, 5);
    EXPECT_TRUE(reader.next());
    EXPECT_TRUE(reader.next());
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.counts().records, 4U);
    EXPECT_EQ(reader.counts().unknown, 2U);
    EXPECT_EQ(reader.counts().damaged, 0U);
}

TEST(MonadoMetrics, TakesTimesThatCannotBeForUnknown) {
    MonadoFile file;
    std::string record;
    protozero::pbf_writer writer(record);
    {
        protozero::pbf_writer fields(writer, 3);
        fields.add_uint64(4, std::numeric_limits<std::uint64_t>::max());
    }
    file.raw(record);
    EXPECT_EQ(only<MonadoUsed>(file).when_ns, 0);
}

TEST(MonadoMetrics, LeavesDamagedRecordsOutAndSaysWhere) {
    MonadoFile file;
    const std::size_t first = file.bytes().size();
    file.raw("\x1a\x7f");                  // longer than the record
    file.raw("\x1a\x02\x22\x7f");          // a time that is no varint
    file.raw(std::string(11, '\xff'));     // a varint without an end
    file.raw(std::string("\x1b", 1));      // a group, which nobody writes
    file.raw(std::string("\x00\x01", 2));  // a field of number 0
    file.used(1, 2, 3, 4);
    auto reader = value_or_throw(file.open());
    EXPECT_EQ(std::get<MonadoUsed>(reader.next().value()).session_frame, 2);
    EXPECT_EQ(reader.counts().damaged, 5U);
    EXPECT_EQ(reader.counts().first_damaged_at, first);
}

TEST(MonadoMetrics, CountsALastRecordThatWasCut) {
    MonadoFile file;
    file.used(1, 2, 3, 4);
    const std::string before = file.bytes();
    file.used(1, 3, 4, 5);
    for (std::size_t size = before.size() + 1; size < file.bytes().size(); ++size) {
        auto reader = value_or_throw(MonadoFile::open_bytes(file.bytes().substr(0, size)));
        EXPECT_TRUE(reader.next());
        EXPECT_FALSE(reader.next());
        EXPECT_FALSE(reader.next()) << "for good";
        EXPECT_EQ(reader.counts().cut_at, before.size());
    }
    auto whole = value_or_throw(MonadoFile::open_bytes(before));
    EXPECT_TRUE(whole.next());
    EXPECT_FALSE(whole.next());
    EXPECT_FALSE(whole.counts().cut_at);
}

TEST(MonadoMetrics, ReadsNotOnBehindALengthThatNoRecordHas) {
    for (const std::string& length : {std::string("\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01"),
                                      std::string("\x81\x80\x04"), std::string(10, '\xff')}) {
        MonadoFile file;
        const std::size_t at = file.bytes().size();
        file.tail(length);
        file.used(1, 2, 3, 4);
        auto reader = value_or_throw(file.open());
        EXPECT_FALSE(reader.next());
        EXPECT_EQ(reader.counts().lost_at, at);
        EXPECT_FALSE(reader.counts().cut_at);
    }
    MonadoFile longest;
    longest.raw(std::string(MonadoMetricsReader::kLongestRecord, '\0'));
    auto reader = value_or_throw(longest.open());
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.counts().lost_at);
    EXPECT_EQ(reader.counts().damaged, 1U);
}

TEST(MonadoMetrics, RefusesWhatIsNoSuchFile) {
    EXPECT_THAT(message(""), AllOf(HasSubstr("m.pb: empty"), HasSubstr("XRT_METRICS_EARLY_FLUSH")));
    EXPECT_THAT(message("event,frame"), AllOf(HasSubstr("m.pb: byte 0: no metrics file of Monado"),
                                              HasSubstr("XRT_METRICS_FILE")));
    EXPECT_THAT(message(std::string(4096, '\0')), HasSubstr("no metrics file"));
    EXPECT_THAT(message(MonadoFile(2, 0).bytes()),
                HasSubstr("its version is 2.0, and 1.x is read"));
    const std::string unversioned = MonadoFile().bytes();
    MonadoFile headless;
    headless.used(1, 2, 3, 4);
    EXPECT_THAT(message(headless.bytes().substr(unversioned.size())), HasSubstr("no metrics file"));
}

TEST(MonadoMetrics, RefusesWhatIsNoFile) {
    const tests::TemporaryFolder folder;
    const auto error = [](const std::filesystem::path& file) {
        const auto reader = MonadoMetricsReader::open(file);
        return reader ? "" : reader.error().message;
    };
    EXPECT_THAT(error(folder / "none.pb"),
                AllOf(HasSubstr("none.pb: No such file"), HasSubstr("monado-service")));
    EXPECT_THAT(error(folder.path()), HasSubstr("it is a folder"));
    EXPECT_THAT(error("/dev/zero"), HasSubstr("/dev/zero: no file of bytes"));
}

TEST(MonadoMetrics, ReadsAFileOfAnyLength) {
    const tests::TemporaryFolder folder;
    MonadoFile file;
    for (std::int64_t i = 1; i <= 50'000; ++i) {
        file.used(1, i, i, i);
    }
    const std::filesystem::path path = folder / "m.pb";
    std::ofstream(path, std::ios::binary) << file.bytes();
    auto reader = value_or_throw(MonadoMetricsReader::open(path));
    std::int64_t last = 0;
    while (const auto record = reader.next()) {
        EXPECT_EQ(std::get<MonadoUsed>(*record).session_frame, last + 1);
        last = std::get<MonadoUsed>(*record).session_frame;
    }
    EXPECT_EQ(last, 50'000);
    EXPECT_EQ(reader.counts().records, 50'001U);
}

}  // namespace
}  // namespace gazeloop::report
