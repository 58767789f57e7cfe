#include "io/eyes/model_files.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace model_files_test {

using namespace godwit::io::eyes;
namespace fs = std::filesystem;

struct model_files_read : testing::Test {
  model_files_read() { fs::create_directories(folder); }
  ~model_files_read() override { fs::remove_all(folder); }
  std::string put(const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name) << bytes;
    return folder / name;
  }
  [[nodiscard]] static std::string problem(const std::string& path) {
    const auto read = read_model(path);
    return read ? "" : read.error();
  }
  fs::path folder = fs::temp_directory_path() / ("godwit_model_files_" + std::to_string(::getpid()));
};

TEST_F(model_files_read, weights_of_darknet_come_with_the_layers_beside_them_and_onnx_alone) {
  put("net.cfg", "[net]");
  const auto darknet = read_model(put("net.weights", "numbers"));
  ASSERT_TRUE(darknet) << darknet.error();
  EXPECT_EQ(darknet->layers, "[net]");
  EXPECT_EQ(darknet->weights, "numbers");
  const auto onnx = read_model(put("net.onnx", "graph"));
  ASSERT_TRUE(onnx) << onnx.error();
  EXPECT_EQ(onnx->layers, "");
  EXPECT_EQ(onnx->weights, "graph");
}

TEST_F(model_files_read, a_file_that_is_missing_empty_huge_or_of_another_kind_is_named) {
  const auto none = (folder / "none").string();
  EXPECT_EQ(problem(none + ".onnx"), none + ".onnx can not be read: No such file or directory");
  EXPECT_EQ(problem(put("lonely.weights", "numbers")),
            (folder / "lonely.cfg").string() + " can not be read: No such file or directory");
  EXPECT_NE(problem(put("empty.onnx", "")).find("has 0 bytes"), std::string::npos);
  const auto huge = put("huge.onnx", "x");
  fs::resize_file(huge, max_model_bytes + 1);
  EXPECT_NE(problem(huge).find("a model has 1 to 67108864"), std::string::npos) << problem(huge);
  EXPECT_NE(problem(put("net.cfg", "[net]")).find("is no model"), std::string::npos);
  fs::create_directories(folder / "folder.onnx");
  EXPECT_NE(problem(folder / "folder.onnx").find("can not be read"), std::string::npos);
}

} // namespace model_files_test
