#include "engine/calibration/intrinsics/yaml_node.h"

#include <charconv>
#include <cmath>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr int kDeepest = 20;  // nested values; keeps a hostile file off the stack's end

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Without a comment that is not inside quotes.
std::string_view withoutComment(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quote != 0)
      quote = line[i] == quote ? 0 : quote;
    else if (line[i] == '"' || line[i] == '\'')
      quote = line[i];
    else if (line[i] == '#' && (i == 0 || line[i - 1] == ' '))
      return line.substr(0, i);
  }
  return line;
}

struct Line {
  int number = 0;
  int indent = 0;
  std::string text;
};

class Parser {
 public:
  Parser(std::string_view text, std::string name) : name_(std::move(name)) {
    int number = 0;
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      addLine(text.substr(0, end), ++number);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  YamlNode parse() {
    if (lines_.empty()) throw Error(ErrorKind::kInput, "the file is empty", name_, "give a camera file");
    YamlNode root = block(lines_.front().indent, 0);
    if (at_ < lines_.size()) fail(lines_[at_].number, "the indentation does not fit");
    return root;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what) const {
    throw Error(ErrorKind::kInput, what, name_ + ":" + std::to_string(line),
                "give a camera file as OpenCV, Kalibr or ROS write it");
  }

  void addLine(std::string_view raw, int number) {
    const std::string_view line = withoutComment(raw);
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '%' || text == "---" || text == "...") return;
    const auto indent = line.find_first_not_of(' ');
    if (line[indent] == '\t') fail(number, "the line is indented by a tab");
    lines_.push_back({number, static_cast<int>(indent), std::string(text)});
  }

  static bool isItem(const std::string& text) { return text == "-" || text.starts_with("- "); }

  /// Where the colon of "key: value" is; none if the line is no such pair.
  static std::size_t colonOf(std::string_view text) {
    if (text.empty() || text.front() == '[' || text.front() == '{') return std::string_view::npos;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == ':' && (i + 1 == text.size() || text[i + 1] == ' ')) return i;
    return std::string_view::npos;
  }

  YamlNode block(int indent, int depth) {
    if (depth > kDeepest) fail(lines_[at_].number, "too deeply nested");
    if (isItem(lines_[at_].text)) return sequence(indent, depth);
    if (colonOf(lines_[at_].text) != std::string_view::npos) return mapping(indent, depth);
    const std::string text = lines_[at_].text;
    return inlineValue(text, depth);
  }

  YamlNode sequence(int indent, int depth) {
    YamlNode node{YamlNode::Kind::kSequence, lines_[at_].number, {}, {}, {}};
    while (at_ < lines_.size() && lines_[at_].indent == indent && isItem(lines_[at_].text)) {
      // The item's text becomes a line of its own, indented behind the dash.
      Line& line = lines_[at_];
      const auto start = line.text.find_first_not_of(' ', 1);
      if (start == std::string::npos) {
        ++at_;
        node.items.push_back(nested(indent, depth, line.number));
        continue;
      }
      line.text.erase(0, start);
      line.indent += static_cast<int>(start);
      node.items.push_back(block(line.indent, depth + 1));
    }
    return node;
  }

  YamlNode mapping(int indent, int depth) {
    YamlNode node{YamlNode::Kind::kMapping, lines_[at_].number, {}, {}, {}};
    while (at_ < lines_.size() && lines_[at_].indent == indent) {
      const std::string text = lines_[at_].text;
      const auto colon = colonOf(text);
      if (isItem(text) || colon == std::string::npos) fail(lines_[at_].number, "this is no 'key: value'");
      const std::string key = unquoted(trimmed(std::string_view(text).substr(0, colon)));
      if (node.find(key) != nullptr) fail(lines_[at_].number, "'" + key + "' is there twice");
      std::string_view value = trimmed(std::string_view(text).substr(colon + 1));
      if (value.starts_with('!')) value = trimmed(value.substr(std::min(value.find(' '), value.size())));
      if (value.empty()) {
        const int line = lines_[at_++].number;
        node.fields.emplace_back(key, nested(indent, depth, line));
      } else {
        node.fields.emplace_back(key, inlineValue(std::string(value), depth));
      }
    }
    return node;
  }

  /// What stands under a key or dash: deeper lines, or a sequence as deep as its key, or nothing.
  YamlNode nested(int indent, int depth, int line) {
    if (at_ < lines_.size() &&
        (lines_[at_].indent > indent ||
         (lines_[at_].indent == indent && isItem(lines_[at_].text) && lines_[at_ - 1].text.back() != '-')))
      return block(lines_[at_].indent, depth + 1);
    return YamlNode{YamlNode::Kind::kNull, line, {}, {}, {}};
  }

  /// A scalar or a flow value that begins on the present line; takes further lines until brackets close.
  YamlNode inlineValue(std::string text, int depth) {
    const int line = lines_[at_++].number;
    if (text.front() != '[' && text.front() != '{')
      return YamlNode{YamlNode::Kind::kScalar, line, unquoted(text), {}, {}};
    while (depthOf(text) > 0) {
      if (at_ >= lines_.size()) fail(line, "a bracket is not closed");
      text += " " + lines_[at_++].text;
    }
    std::string_view rest = text;
    YamlNode node = flow(rest, line, depth + 1);
    if (!trimmed(rest).empty()) fail(line, "something stands behind the closing bracket");
    return node;
  }

  static int depthOf(std::string_view text) {
    int depth = 0;
    for (const char c : text) depth += (c == '[' || c == '{') ? 1 : (c == ']' || c == '}') ? -1 : 0;
    return depth;
  }

  YamlNode flow(std::string_view& rest, int line, int depth) {
    if (depth > kDeepest) fail(line, "too deeply nested");
    const char open = rest.front(), close = open == '[' ? ']' : '}';
    YamlNode node{open == '[' ? YamlNode::Kind::kSequence : YamlNode::Kind::kMapping, line, {}, {}, {}};
    rest.remove_prefix(1);
    while (true) {
      rest = trimmed(rest);
      if (rest.empty()) fail(line, "a bracket is not closed");
      if (rest.front() == close) break;
      if (rest.front() == ',') {
        rest.remove_prefix(1);
        continue;
      }
      std::string key;
      if (open == '{') {
        const auto colon = rest.find(':');
        if (colon == std::string_view::npos) fail(line, "this is no 'key: value'");
        key = unquoted(trimmed(rest.substr(0, colon)));
        rest = trimmed(rest.substr(colon + 1));
        if (rest.empty()) fail(line, "a bracket is not closed");
      }
      YamlNode value;
      if (rest.front() == '[' || rest.front() == '{') {
        value = flow(rest, line, depth + 1);
      } else {
        if (open == '[' && rest.front() == '}') fail(line, "a bracket is closed by one of another kind");
        const auto end = std::min(rest.find_first_of(",]}"), rest.size());
        value = YamlNode{YamlNode::Kind::kScalar, line, unquoted(trimmed(rest.substr(0, end))), {}, {}};
        rest.remove_prefix(end);
      }
      if (open == '{')
        node.fields.emplace_back(key, std::move(value));
      else
        node.items.push_back(std::move(value));
    }
    rest.remove_prefix(1);
    return node;
  }

  static std::string unquoted(std::string_view text) {
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
      text = text.substr(1, text.size() - 2);
    return std::string(text);
  }

  std::string name_;
  std::vector<Line> lines_;
  std::size_t at_ = 0;
};

bool flatten(const YamlNode& node, std::vector<double>& out) {
  if (node.kind == YamlNode::Kind::kSequence) {
    for (const YamlNode& item : node.items)
      if (!flatten(item, out)) return false;
    return true;
  }
  const auto value = node.number();
  if (value) out.push_back(*value);
  return value.has_value();
}

}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const auto& [name, value] : fields)
    if (name == key) return &value;
  return nullptr;
}

std::optional<double> YamlNode::number() const {
  double value = 0.0;
  const char* const end = scalar.data() + scalar.size();
  const char* const start = scalar.starts_with('+') ? scalar.data() + 1 : scalar.data();
  const auto [stop, error] = std::from_chars(start, end, value);
  // OpenCV writes "1." for 1.0, which from_chars takes whole.
  if (kind != Kind::kScalar || error != std::errc() || stop != end || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::optional<std::vector<double>> YamlNode::numbers() const {
  std::vector<double> out;
  if (kind != Kind::kSequence || !flatten(*this, out)) return std::nullopt;
  return out;
}

YamlNode parseYaml(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

}  // namespace helical
