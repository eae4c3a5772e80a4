// References on disk: what is stored is found, what is damaged is not, and the key follows every input.
#include "renderer/reference/cache.h"
#include "renderer/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <set>

namespace lightsweep {
namespace {

namespace fs = std::filesystem;

Image small_image() {
    Image image(3, 2, ColorSpace::linear);
    for (size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = 0.1F + 1e4F * static_cast<float>(i);
    return image;
}

class Cache : public testing::Test {
  protected:
    Cache() { fs::remove_all(folder_); }
    ~Cache() override { fs::remove_all(folder_); }

    const fs::path folder_ =
        fs::path(testing::TempDir()) /
        ("reference_cache_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    const ReferenceCache cache_{folder_ / "deep" / "down"};
    const fs::path file_ = folder_ / "deep" / "down" / "abc.exr";
};

TEST_F(Cache, FindsWhatWasStored) {
    EXPECT_FALSE(cache_.find("abc", 3, 2)) << "not there yet";
    const Image image = small_image();
    cache_.store("abc", image);
    const auto found = cache_.find("abc", 3, 2);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->rgb, image.rgb) << "every bit";
    EXPECT_EQ(found->space, ColorSpace::linear);
    EXPECT_FALSE(cache_.find("abd", 3, 2)) << "another key";
}

TEST_F(Cache, LeavesOneFilePerKey) {
    cache_.store("abc", small_image());
    Image brighter = small_image();
    brighter.rgb[0] = 7.0F;
    cache_.store("abc", brighter);
    EXPECT_EQ(cache_.find("abc", 3, 2)->rgb[0], 7.0F);
    EXPECT_EQ(std::distance(fs::directory_iterator(file_.parent_path()), fs::directory_iterator()), 1);
}

TEST_F(Cache, DoesNotTakeAnotherSize) {
    cache_.store("abc", small_image());
    EXPECT_FALSE(cache_.find("abc", 2, 3));
    EXPECT_FALSE(cache_.find("abc", 3, 3));
    EXPECT_FALSE(cache_.find("abc", 2, 2));
}

TEST_F(Cache, DoesNotTakeDamagedFiles) {
    cache_.store("abc", small_image());
    const std::string bytes = read_file(file_);
    for (const std::string& damaged :
         {std::string(), std::string("not a picture"), bytes.substr(0, bytes.size() - 8), bytes.substr(0, 40)}) {
        write_file_atomically(file_, damaged);
        EXPECT_FALSE(cache_.find("abc", 3, 2)) << damaged.size() << " of " << bytes.size() << " bytes";
        cache_.store("abc", small_image());
        EXPECT_TRUE(cache_.find("abc", 3, 2)) << "it can be stored again";
    }
}

TEST_F(Cache, ThatCannotBeWrittenIsNoError) {
    fs::create_directories(folder_);
    write_file_atomically(folder_ / "deep", "a file where the folder should be");
    cache_.store("abc", small_image());
    EXPECT_FALSE(cache_.find("abc", 3, 2));
}

// Sets an environment variable for as long as it lives; nullptr unsets it.
class Environment {
  public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        set(value);
    }
    ~Environment() { set(old_ ? old_->c_str() : nullptr); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    void set(const char* value) const {
        if (value == nullptr) {
            ::unsetenv(name_);
        } else {
            ::setenv(name_, value, 1);
        }
    }
    const char* name_;
    std::optional<std::string> old_;
};

TEST_F(Cache, StandsWhereTheEnvironmentSays) {
    const fs::path own = folder_ / "own", xdg = folder_ / "xdg", home = folder_ / "home";
    const Environment set_home("HOME", home.c_str());
    {
        const Environment no_own("LIGHTSWEEP_CACHE", nullptr), relative_xdg("XDG_CACHE_HOME", "somewhere");
        ReferenceCache().store("abc", small_image());
        EXPECT_TRUE(fs::exists(home / ".cache/lightsweep/abc.exr"));
    }
    const Environment set_xdg("XDG_CACHE_HOME", xdg.c_str());
    {
        const Environment no_own("LIGHTSWEEP_CACHE", "");
        ReferenceCache().store("abc", small_image());
        EXPECT_TRUE(fs::exists(xdg / "lightsweep/abc.exr"));
    }
    const Environment set_own("LIGHTSWEEP_CACHE", own.c_str());
    ReferenceCache().store("abc", small_image());
    EXPECT_TRUE(fs::exists(own / "abc.exr"));
}

// --- Keys ---

struct Inputs {
    Scene scene;
    Camera camera;
    std::vector<Light> lights{Light{}, Light{.kind = LightKind::spot}};
    Visibility visible{.width = 2, .height = 1, .triangles = {{0, 5}, {}}, .texels = std::vector<SampledTexels>(2)};
    int subpixel_bits = 0;

    Inputs() { scene.content_hash = "0123456789abcdef"; }
    std::string key() const { return reference_key(scene, camera, lights, visible, subpixel_bits); }
};

TEST(ReferenceKey, IsTheSameForTheSameInputs) {
    EXPECT_EQ(Inputs().key(), Inputs().key());
    EXPECT_THAT(Inputs().key(), testing::MatchesRegex("[0-9a-f]+"));
}

TEST(ReferenceKey, FollowsEveryInput) {
    const std::vector<std::function<void(Inputs&)>> changes{
        [](Inputs&) {},
        [](Inputs& i) { i.scene.content_hash[3] = 'x'; },
        [](Inputs& i) { i.camera.eye.x += 1e-12; },
        [](Inputs& i) { i.camera.target.y = 2; },
        [](Inputs& i) { i.camera.up.z = 0.1; },
        [](Inputs& i) { i.camera.fov_y_deg = 61; },
        [](Inputs& i) { i.camera.near_distance = 0.2; },
        [](Inputs& i) { i.camera.far_distance = 101; },
        [](Inputs& i) { i.lights.pop_back(); },
        [](Inputs& i) { std::swap(i.lights[0], i.lights[1]); },
        [](Inputs& i) { i.lights[0].kind = LightKind::directional; },
        [](Inputs& i) { i.lights[0].position.x = 1e-9; },
        [](Inputs& i) { i.lights[0].direction.y = 1; },
        [](Inputs& i) { i.lights[0].color.z = 0.5; },
        [](Inputs& i) { i.lights[0].radius = 2; },
        [](Inputs& i) { i.lights[1].inner_deg = 10; },
        [](Inputs& i) { i.lights[1].outer_deg = 31; },
        [](Inputs& i) { std::swap(i.visible.width, i.visible.height); },
        [](Inputs& i) { i.visible.triangles[0].triangle = 6; },
        [](Inputs& i) { i.visible.triangles[1].instance = 0; },
        [](Inputs& i) { i.visible.texels[1].metallic = 0.5F; },
        [](Inputs& i) { i.visible.texels.clear(); },
        [](Inputs& i) { i.subpixel_bits = 8; },
    };
    std::set<std::string> keys;
    for (const auto& change : changes) {
        Inputs inputs;
        change(inputs);
        keys.insert(inputs.key());
    }
    EXPECT_EQ(keys.size(), changes.size());
}

}  // namespace
}  // namespace lightsweep
