#include "base/process_memory.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace coordreq {
namespace {

/// Control groups in a folder of their own.
class Processors : public testing::Test {
 protected:
  Processors() { std::filesystem::create_directories(root_); }
  ~Processors() override { std::filesystem::remove_all(root_); }

  void write(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = root_ + path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  }

  std::string root_ = testing::TempDir() + "coordreq_processors_test";
};

TEST_F(Processors, QuotaOfVersion2) {
  write("/a/cpu.max", "150000 100000");
  EXPECT_EQ(processor_quota("0::/a\n", root_), 1.5);
  EXPECT_EQ(processor_quota("0::/a/b\n", root_), 1.5);  // of the group around it
  write("/a/b/cpu.max", "50000 100000");
  EXPECT_EQ(processor_quota("0::/a/b\n", root_), 0.5);
  write("/a/b/cpu.max", "max 100000");
  EXPECT_EQ(processor_quota("0::/a/b\n", root_), 1.5);
  EXPECT_TRUE(std::isinf(processor_quota("0::/c\n", root_)));
  write("/cpu.max", "25000 100000");  // a container sees its own group at the root
  EXPECT_EQ(processor_quota("0::/\n", root_), 0.25);
}

TEST_F(Processors, QuotaOfVersion1) {
  write("/cpu,cpuacct/a/cpu.cfs_quota_us", "300000");
  write("/cpu,cpuacct/a/cpu.cfs_period_us", "100000");
  EXPECT_EQ(processor_quota("7:memory:/b\n4:cpu,cpuacct:/a\n", root_), 3);
  EXPECT_TRUE(std::isinf(processor_quota("7:cpuset:/a\n", root_)));
  write("/cpu,cpuacct/a/cpu.cfs_quota_us", "-1");
  EXPECT_TRUE(std::isinf(processor_quota("4:cpu,cpuacct:/a\n", root_)));
}

TEST(UsableProcessors, AreNoMoreThanThoseOfTheAffinity) {
  cpu_set_t allowed;
  ASSERT_EQ(sched_getaffinity(0, sizeof(allowed), &allowed), 0);
  EXPECT_GE(usable_processors(), 1);
  EXPECT_LE(usable_processors(), CPU_COUNT(&allowed));
}

}  // namespace
}  // namespace coordreq
