#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/element_type.h>
#include <vibrocontact/scene/physical_tags.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <vector>

namespace vibrocontact
{
  namespace
  {
    using Tags = std::unordered_map<std::size_t, unsigned int>;

    /// Lines "number type n_tags tags nodes".
    void read_text(std::istream &stream, Tags &result)
    {
      std::string line;
      std::getline(stream, line);
      while (std::getline(stream, line) && line[0] != '$')
      {
        std::istringstream words(line);
        std::size_t number;
        long type, n_tags, group;
        if (words >> number >> type >> n_tags)
          result[number] = n_tags > 0 && words >> group && group > 0 ? group : 0;
      }
    }

    /// Blocks "type, n, n_tags", each followed by n times "number, tags, nodes".
    void read_binary(std::istream &stream, Tags &result)
    {
      std::string line;
      std::getline(stream, line);
      const auto read = [&](std::vector<std::int32_t> &values)
      { return bool(stream.read(reinterpret_cast<char *>(values.data()), 4 * values.size())); };
      std::vector<std::int32_t> head(3);
      while (read(head))
      {
        const ElementType *const kind = head[0] > 0 ? element_type(head[0]) : nullptr;
        if (!kind || head[1] < 0 || head[2] < 0 || head[2] > 1000)
          return;
        std::vector<std::int32_t> element(1 + head[2] + kind->n_nodes);
        for (std::int32_t k = 0; k < head[1] && read(element); ++k)
          result[element[0]] = head[2] > 0 && element[1] > 0 ? element[1] : 0;
      }
    }
  } // namespace

  Tags physical_tags_of_format_2(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    double version = 0;
    int is_binary = 0;
    Tags result;
    while (std::getline(stream, line))
      if (line.rfind("$MeshFormat", 0) == 0)
      {
        std::getline(stream, line);
        std::istringstream(line) >> version >> is_binary;
        if (version < 2 || version >= 3)
          return {};
        std::int32_t one = 1;
        if (is_binary && stream.read(reinterpret_cast<char *>(&one), 4) && one != 1)
          throw InputError("its numbers are in the byte order of another machine");
      }
      else if (line.rfind("$Elements", 0) == 0)
      {
        is_binary ? read_binary(stream, result) : read_text(stream, result);
        return result;
      }
    return result;
  }
} // namespace vibrocontact
