#include "programs/godwit-eyes/detection/classifier.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string_view>
#include <utility>
#include <vector>

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "programs/godwit-eyes/detection/thread_time.hpp"

namespace godwit::eyes {

namespace {

constexpr int values_before_classes = 5; // middle, size, and how sure it is that there is something
constexpr int coco_classes = 80;
constexpr int row_values = values_before_classes + coco_classes;
// What the net finds is the thing: its middle is so near, by the thing's length, and its length is so much of that.
constexpr double middle_within = 0.6;
constexpr double least_length = 0.3;
constexpr double most_length = 3;
constexpr double crop_by_length = 1.6; // side of the part that the net is given, by the length of the thing
constexpr double least_crop_px = 40;
constexpr std::size_t darknet_head_bytes = 16; // version, and how many pictures it has learned from; of newer ones 20

object_class class_of(int coco) {
  constexpr int bicycle = 1;
  constexpr int truck = 7;
  constexpr int boat = 8;
  constexpr int bird = 14;
  constexpr int giraffe = 23;
  if (coco == 0)
    return object_class::person;
  if (coco >= bicycle && coco <= truck)
    return object_class::vehicle;
  if (coco == boat)
    return object_class::boat;
  return coco >= bird && coco <= giraffe ? object_class::animal : object_class::unknown;
}

// Of Darknet's weights, which do not say how many they are: with too few the rest would be chance.
std::size_t bytes_needed(cv::dnn::Net& net) {
  std::size_t values = 0;
  for (const auto& name : net.getLayerNames()) {
    const auto layer = net.getLayer(net.getLayerId(name));
    if (layer->type == "Convolution" || layer->type == "BatchNorm" || layer->type == "InnerProduct")
      for (const auto& each : layer->blobs)
        values += each.total();
  }
  return darknet_head_bytes + values * sizeof(float);
}

// The part of a plane around a place, as large as the net wants it; beyond the picture its border goes on.
cv::Mat part_of(const std::uint8_t* pixels, const cv::Size& size, std::size_t stride, const cv::Point2d& middle,
                double side) {
  // OpenCV has no view of constant pixels; these are only read.
  const cv::Mat plane(size, CV_8UC1, const_cast<std::uint8_t*>(pixels), stride);
  const double scale = classifier::input_px / side;
  const cv::Matx23d way(scale, 0, (side / 2 - middle.x) * scale, 0, scale, (side / 2 - middle.y) * scale);
  cv::Mat result;
  cv::warpAffine(plane, result, way, cv::Size(classifier::input_px, classifier::input_px), cv::INTER_LINEAR,
                 cv::BORDER_REPLICATE);
  return result;
}

cv::Mat colours_of(const frame_view& picture, const cv::Point2d& middle, double side) {
  const cv::Mat grey = part_of(picture.grey, {picture.width, picture.height}, picture.stride, middle, side);
  cv::Mat result;
  if (picture.blue == nullptr || picture.red == nullptr) {
    cv::cvtColor(grey, result, cv::COLOR_GRAY2RGB);
    return result;
  }
  const cv::Size half(picture.width / 2, picture.height / 2);
  const std::array<cv::Mat, 3> planes{grey, part_of(picture.red, half, picture.colour_stride, middle / 2, side / 2),
                                      part_of(picture.blue, half, picture.colour_stride, middle / 2, side / 2)};
  cv::merge(planes.data(), planes.size(), result);
  cv::cvtColor(result, result, cv::COLOR_YCrCb2RGB);
  return result;
}

} // namespace

struct classifier::parts {
  cv::dnn::Net net;
  std::vector<std::string> outputs;
  bool is_darknet = false;

  [[nodiscard]] std::vector<cv::Mat> rows_for(const cv::Mat& colours) {
    net.setInput(cv::dnn::blobFromImage(colours, 1.0 / 255));
    std::vector<cv::Mat> result;
    net.forward(result, outputs);
    for (auto& each : result)
      if (each.dims == 3 && each.size[0] == 1)
        each = each.reshape(1, each.size[1]);
    return result;
  }
};

tl::expected<std::shared_ptr<classifier>, std::string> classifier::make(const io::eyes::model_files& from) try {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); // the sentence says it
  auto all = std::make_unique<parts>();
  all->is_darknet = !from.layers.empty();
  all->net = all->is_darknet ? cv::dnn::readNetFromDarknet(from.layers.data(), from.layers.size(), from.weights.data(),
                                                           from.weights.size())
                             : cv::dnn::readNetFromONNX(from.weights.data(), from.weights.size());
  if (all->net.empty())
    return tl::make_unexpected("there is no layer in it");
  if (all->is_darknet)
    if (const auto needed = bytes_needed(all->net); needed > from.weights.size())
      return tl::make_unexpected("its .weights have " + std::to_string(from.weights.size()) +
                                 " bytes, and its .cfg needs " + std::to_string(needed));
  all->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  all->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  all->outputs = all->net.getUnconnectedOutLayersNames();
  const cv::Mat even(input_px, input_px, CV_8UC3, cv::Scalar::all(128));
  static_cast<void>(all->rows_for(even)); // the first time it also makes its room
  const double begin = thread_ms();
  for (const auto& each : all->rows_for(even))
    if (each.dims != 2 || each.cols != row_values || each.depth() != CV_32F)
      return tl::make_unexpected("it does not give rows of " + std::to_string(row_values) +
                                 " numbers, as a net for COCO's 80 classes does");
  if (const double took = thread_ms() - begin; took > most_ms)
    return tl::make_unexpected("an answer takes " + std::to_string(std::lround(took)) + " ms, more than " +
                               std::to_string(std::lround(most_ms)) + ": use a smaller net");
  return std::shared_ptr<classifier>(new classifier(std::move(all)));
} catch (const std::exception& why) { // cv::Exception, and what the parsers of OpenCV let through
  const std::string_view all = why.what();
  return tl::make_unexpected("OpenCV does not read it: " + std::string(all.substr(0, all.find('\n'))));
}

classifier::classifier(std::unique_ptr<parts> all) : parts_(std::move(all)) {}
classifier::~classifier() = default;

class_answer classifier::ask(const frame_view& picture, const pixel_box& about) {
  const double length = std::max(about.width_px, about.height_px);
  const double side = std::max(least_crop_px, crop_by_length * length);
  const cv::Point2d middle(about.x_px + about.width_px / 2, about.y_px + about.height_px / 2);
  const double unit = parts_->is_darknet ? side : side / input_px; // Darknet's boxes are shares of what it was given
  class_answer best;
  for (const auto& rows : parts_->rows_for(colours_of(picture, middle, side)))
    for (int n = 0; n < rows.rows; ++n) {
      const auto* const row = rows.ptr<float>(n);
      const cv::Point2d off(row[0] * unit - side / 2, row[1] * unit - side / 2);
      const cv::Size2d size(row[2] * unit, row[3] * unit);
      const double found_length = std::max(size.width, size.height);
      const bool is_it = std::isfinite(off.x + off.y + size.width + size.height) &&
                         std::min(size.width, size.height) > 0 &&
                         std::max(std::abs(off.x), std::abs(off.y)) <= middle_within * length &&
                         found_length >= least_length * length && found_length <= most_length * length;
      for (int coco = 0; is_it && coco < coco_classes; ++coco) {
        // Those of Darknet are multiplied already.
        const double score =
            row[values_before_classes + coco] * (parts_->is_darknet ? 1 : row[values_before_classes - 1]);
        if (const auto what = class_of(coco);
            what != object_class::unknown && score >= least_score && score <= 1 && score > best.score)
          best = {what,
                  score,
                  {middle.x + off.x - size.width / 2, middle.y + off.y - size.height / 2, size.width, size.height}};
      }
    }
  return best;
}

} // namespace godwit::eyes
