#include "bench/measure/list_probe.h"

#include <gmock/gmock.h>

namespace lightsweep {
namespace {

using ::testing::HasSubstr;

TEST(ListProbeText, the_faster_builder_is_named_with_both_times) {
    const ListProbe probe{.lights = 1024, .cpu_ns = 310'000, .compute_ns = 1'900'000};
    EXPECT_EQ(probe.faster(), ListBuilder::cpu);
    EXPECT_EQ(probe.why(), "cpu 0.31 ms, compute 1.9 ms for 1,024 lights");
    EXPECT_EQ(to_json(probe), (Json{{"lights", 1024},
                                    {"cpu_ns", 310'000},
                                    {"compute_ns", 1'900'000},
                                    {"faster", "cpu"},
                                    {"why", probe.why()}}));
    const ListProbe gpu{.lights = 1024, .cpu_ns = 310'000, .compute_ns = 20'000};
    EXPECT_EQ(gpu.faster(), ListBuilder::compute);
    EXPECT_EQ(to_json(gpu).at("faster"), "compute");
}

TEST(ListProbeText, a_device_that_refuses_compute_leaves_the_cpu) {
    const ListProbe probe{.lights = 1024, .cpu_ns = 310'000, .compute_ns = {}, .refusal = "no compute shaders"};
    EXPECT_EQ(probe.faster(), ListBuilder::cpu);
    EXPECT_THAT(probe.why(), HasSubstr("compute: no compute shaders"));
    EXPECT_TRUE(to_json(probe).at("compute_ns").is_null());
}

}  // namespace
}  // namespace lightsweep
