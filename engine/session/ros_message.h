#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/session/cdr.h"

namespace helical {

/// Messages of any definition (schema encoding `ros2msg`) as rows of a table. Structures inside are columns
/// of their own, as are the elements of arrays of fixed length. A list of structures makes a row of each of
/// its elements, and one row when it is empty; a list of numbers is one cell. One thread.
class RosMessage {
 public:
  /// Throws Error(kInput) naming `name` for what it cannot read: unknown types, lists in lists.
  RosMessage(const std::string& name, const std::string& definition);

  struct Column {
    std::string name;  ///< "pose.position.x"
    std::string unit;  ///< "m"; empty where there is none
  };
  const std::vector<Column>& columns() const { return columns_; }

  /// One call a row, with as many cells as there are columns. Throws CutShort when the payload does not fit
  /// the definition.
  void rows(std::string_view payload, const std::function<void(const std::vector<std::string>&)>& show) const;

 private:
  struct Field {
    std::string type;
    std::string name;
    int count = kOne;
  };
  static constexpr int kOne = -1, kAny = 0;
  using Cells = std::vector<std::string>;

  void parse(const std::string& definition);
  void addColumns(const std::string& type, const std::string& prefix, bool in_list);
  void read(CdrReader& in, const std::string& type, Cells& cells, std::vector<Cells>& list,
            std::size_t& list_at) const;
  void readList(CdrReader& in, const std::string& type, Cells& cells, std::vector<Cells>& list,
                std::size_t& list_at) const;
  [[noreturn]] void refuse(const std::string& what) const;

  std::string name_;
  std::map<std::string, std::vector<Field>> types_;  ///< the message itself: ""
  std::vector<Column> columns_;
};

}  // namespace helical
