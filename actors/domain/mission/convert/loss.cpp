#include "actors/domain/mission/convert/loss.hpp"

namespace godwit::mission {

std::string loss::message() const {
  const auto in_file = line.empty() ? std::string() : " (" + line + ')';
  const auto place = item ? "item " + std::to_string(*item) + in_file + ": " : std::string();
  return place + what + "; " + why + "; instead: " + instead;
}

void loss_list::add(loss each) {
  if (all.size() < max_losses)
    all.push_back(std::move(each));
  else
    ++omitted;
}

void loss_list::add(loss_list others) {
  for (auto& each : others.all)
    add(std::move(each));
  omitted += others.omitted;
}

std::string loss_list::message() const {
  std::string result;
  for (const auto& each : all)
    result += (result.empty() ? "" : "\n") + each.message();
  if (omitted != 0)
    result += "\nand " + std::to_string(omitted) + " further losses";
  return result;
}

} // namespace godwit::mission
