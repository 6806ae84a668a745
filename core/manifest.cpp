#include "core/manifest.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/modest_json.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;

/// The file that this code was loaded from: the program, or a library in somebody else's.
std::string own_file() {
  Dl_info info;
  void* map = nullptr;
  if (::dladdr1(reinterpret_cast<const void*>(&own_file), &info, &map, RTLD_DL_LINKMAP) == 0) return "/proc/self/exe";
  const std::string file = static_cast<const link_map*>(map)->l_name;
  return file.empty() ? "/proc/self/exe" : file;
}

const std::string& program() {
  static const std::string hash = sha256_of_file(own_file());
  return hash;
}

Json json_of(const RunIdentity& identity) {
  std::set<std::string> inputs;  // in an order that does not hang on where they lie
  for (const auto& [path, hash] : identity.inputs) inputs.insert(hash);
  return {{"command", identity.command}, {"program", program()}, {"options", identity.options}, {"inputs", inputs}};
}

std::string text_of(const Json& options, const std::string& key) {
  return options.contains(key) ? options[key].dump() : "not given";
}

/// `was` is an identity that may be anything.
bool is_same_command(const Json& was, const Json& is) {
  return was.is_object() && was.value("command", Json()) == is["command"];
}

std::optional<std::string> difference_between(const Json& was, const Json& is, const RunIdentity& identity) {
  if (was == is) return std::nullopt;
  if (!is_same_command(was, is)) return "it was made by another command";
  if (was.value("program", Json()) != is["program"]) return "the program is another build";
  const Json options = was.value("options", Json::object());
  for (const auto& [key, value] : is["options"].items())
    if (!options.is_object() || options.value(key, Json()) != value)
      return fmt::format("{} was {}, is {}", key, text_of(options, key), value.dump());
  const Json inputs = was.value("inputs", Json::array());
  std::vector<std::string> changed;
  for (const auto& [path, hash] : identity.inputs)
    if (std::find(inputs.begin(), inputs.end(), Json(hash)) == inputs.end()) changed.push_back(path);
  if (!changed.empty())
    return fmt::format("{} {} changed", fmt::join(changed, ", "), changed.size() > 1 ? "have" : "has");
  return "it had other options or files";
}

/// What a line holds; no value where it is cut short or damaged, or nested deeper than what writes JSON can follow.
Json parsed(const std::string& line, const std::string& file) {
  constexpr JsonMemory kMemory{.per_value = 100, .per_byte = 4};  // as of other JSON
  try {
    require_modest_json(line, file, kMemory);
  } catch (const Error&) {
    return Json(Json::value_t::discarded);
  }
  return Json::parse(line, nullptr, false);
}

/// A file's line as add() writes it, or nothing.
std::optional<std::pair<std::string, Json>> file_in(const std::string& line, const std::string& manifest) {
  const Json json = parsed(line, manifest);
  if (!json.is_object() || json.size() != 3) return std::nullopt;
  const auto name = json.find("file"), bytes = json.find("bytes"), sha256 = json.find("sha256");
  if (name == json.end() || bytes == json.end() || sha256 == json.end()) return std::nullopt;
  if (!name->is_string() || !bytes->is_number_unsigned() || !sha256->is_string()) return std::nullopt;
  return std::pair(name->get<std::string>(), json);
}

}  // namespace

Manifest::Manifest(fs::path folder, const RunIdentity& identity)
    : folder_(std::move(folder)), path_(folder_ / "manifest.jsonl"), identity_(json_of(identity)) {
  exists_ = fs::exists(path_);
  if (!exists_) return;
  std::istringstream lines(read_text(path_));
  std::string line;
  std::getline(lines, line);
  const Json was = parsed(line, path_.string());
  difference_ = difference_between(was, identity_, identity);
  is_same_command_ = is_same_command(was, identity_);
  if (difference_) return;
  while (std::getline(lines, line))
    if (auto file = file_in(line, path_.string()))
      files_.insert_or_assign(std::move(file->first), std::move(file->second));
}

void Manifest::require_same_run(std::span<const std::string> names) const {
  if (difference_)
    throw Error(path_.string(), fmt::format("is of another run: {}; choose another folder", *difference_));
  require_same_command(names);
}

void Manifest::require_same_command(std::span<const std::string> names) const {
  if (exists_ && !is_same_command_)
    throw Error(path_.string(), "is of another command, or damaged; choose another folder");
  if (exists_) return;
  for (const std::string& name : names)
    if (fs::exists(folder_ / name)) throw Error((folder_ / name).string(), "is there already; choose another folder");
}

void Manifest::forget_files() const {
  const std::string text = read_text(path_);
  write_text(path_, text.substr(0, text.find('\n')) + '\n');
}

void Manifest::begin() {
  finish();
  exists_ = true;
  difference_.reset();
  appended_.open(path_, std::ios::binary | std::ios::app);
}

bool Manifest::holds(const std::string& name) const {
  const auto noted = files_.find(name);
  if (noted == files_.end()) return false;
  const fs::path file = folder_ / name;
  std::error_code missing;
  if (!fs::is_regular_file(file, missing) || Json(fs::file_size(file, missing)) != noted->second["bytes"]) return false;
  return Json(sha256_of_file(file)) == noted->second["sha256"];
}

void Manifest::add(const std::string& name) {
  const fs::path file = folder_ / name;
  Json line{{"file", name}, {"bytes", fs::file_size(file)}, {"sha256", sha256_of_file(file)}};
  const std::lock_guard lock(adding_);
  appended_ << line.dump() << '\n' << std::flush;
  if (!appended_) throw Error(path_.string(), "cannot be written: disk full or not writable");
  files_.insert_or_assign(name, std::move(line));
}

void Manifest::finish() {
  if (appended_.is_open()) appended_.close();
  std::string text = identity_.dump() + '\n';
  for (const auto& [name, line] : files_) text += line.dump() + '\n';
  write_text(path_, text);
}

}  // namespace fathom
