#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/utf8.h>
#include <vibrocontact/receptances/sampled_response.h>
#include <vibrocontact/receptances/si_label.h>
#include <vibrocontact/receptances/uff58.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// function types of record 6
    constexpr int unknown_function = 0, time_response = 1, frequency_response = 4;
    /// of times that a file gives one by one: 6 digits
    constexpr double rounding_of_times = 6e-6;
    /// specific data types of records 8 to 10
    constexpr int displacement = 8, velocity = 11, acceleration = 12, excitation_force = 13,
                  reaction_force = 9, time_axis = 17, frequency_axis = 18;

    /// Goes through the bytes of a file line by line, or byte by byte in binary data.
    class Cursor
    {
    public:
      Cursor(const std::string &file_name, const std::string &bytes) : file_name(file_name), bytes(bytes) {}

      bool at_end() const { return position >= bytes.size(); }
      unsigned int line_number() const { return line; }

      std::string next_line()
      {
        if (at_end())
          fail("ends in the middle of a dataset: it is not complete.");
        const std::size_t end = std::min(bytes.find('\n', position), bytes.size());
        std::string text = bytes.substr(position, end - position);
        position = end + 1;
        ++line;
        if (!text.empty() && text.back() == '\r')
          text.pop_back();
        return text;
      }

      std::string next_bytes(const std::size_t n)
      {
        if (at_end() ? n > 0 : n > bytes.size() - position)
          fail("ends in the middle of binary data: it is not complete.");
        position += n;
        return bytes.substr(position - n, n);
      }

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("The universal file \"" + file_name + "\", line " + std::to_string(line) + ", " +
                         as_utf8(what));
      }

      /// A number in columns begin to begin + width of a line; blank is zero.
      double number(const std::string &text, const std::size_t begin, const std::size_t width) const
      {
        std::string field = begin < text.size() ? trimmed(text.substr(begin, width)) : "";
        std::replace(field.begin(), field.end(), 'D', 'E');
        std::replace(field.begin(), field.end(), 'd', 'e');
        if (field.empty())
          return 0;
        char *end = nullptr;
        const double value = std::strtod(field.c_str(), &end);
        if (*end != 0 || !std::isfinite(value))
          fail("has '" + field + "' where a number is due.");
        return value;
      }
      int integer(const std::string &text, const std::size_t begin, const std::size_t width) const
      {
        const double value = number(text, begin, width);
        if (std::abs(value) > std::numeric_limits<int>::max())
          fail("has '" + trimmed(text.substr(begin, width)) + "' where a whole number is due.");
        return std::lround(value);
      }

    private:
      const std::string &file_name, &bytes;
      std::size_t position = 0;
      unsigned int line = 0;
    };

    /// What precedes the data of a dataset 58b.
    struct Binary
    {
      bool is = false, big_endian = false;
      std::size_t n_bytes = 0;
    };

    /// What an axis measures, and the label of its unit.
    struct Axis
    {
      int type = 0;
      std::string unit;
    };

    /// One dataset 58 as it stands in the file.
    struct Function
    {
      std::string response_entity, reference_entity;
      int response_node = 0, response_direction = 0, reference_node = 0, reference_direction = 0;
      int type = 0;
      Axis along, numerator, denominator;
      /// the abscissa is a first value and a step
      bool even = false;
      std::vector<double> abscissa;
      std::vector<Complex> values;
      unsigned int line = 0;
    };

    std::vector<double> read_ascii(Cursor &cursor, const std::vector<unsigned int> &widths,
                                   const std::size_t n)
    {
      std::vector<double> numbers;
      while (numbers.size() < n)
      {
        const std::string text = cursor.next_line();
        if (trimmed(text) == "-1")
          cursor.fail("ends a dataset after " + std::to_string(numbers.size()) + " of its " +
                      std::to_string(n) + " numbers: it is not complete.");
        std::size_t begin = 0;
        for (const unsigned int width : widths)
          if (numbers.size() < n)
          {
            if (begin >= text.size() || trimmed(text.substr(begin, width)).empty())
              cursor.fail("lacks a number: there is a gap in the data.");
            numbers.push_back(cursor.number(text, begin, width));
            begin += width;
          }
      }
      return numbers;
    }

    std::vector<double> read_binary(Cursor &cursor, const std::vector<unsigned int> &sizes,
                                    const std::size_t n, const Binary &binary)
    {
      std::vector<double> numbers;
      std::size_t used = 0;
      for (std::size_t i = 0; i < n; ++i)
      {
        const unsigned int size = sizes[i % sizes.size()];
        std::string raw = cursor.next_bytes(size);
        used += size;
        if (binary.big_endian)
          std::reverse(raw.begin(), raw.end());
        double value = 0;
        if (size == 8)
          std::memcpy(&value, raw.data(), 8);
        else
        {
          float single = 0;
          std::memcpy(&single, raw.data(), 4);
          value = single;
        }
        if (!std::isfinite(value))
          cursor.fail(
              "is followed by binary data with a value that is no number: there is a gap in the data.");
        numbers.push_back(value);
      }
      if (used > binary.n_bytes)
        cursor.fail("announces fewer bytes than its values need: the file is damaged.");
      cursor.next_bytes(binary.n_bytes - used);
      return numbers;
    }

    /// Of records 8 to 10: I10, 3 I5, 2 (1X, A20).
    Axis read_axis(Cursor &cursor)
    {
      std::string text = cursor.next_line();
      text.resize(80, ' ');
      return {cursor.integer(text, 0, 10), as_utf8(trimmed(text.substr(47, 20)))};
    }

    Function read_function(Cursor &cursor, const Binary &binary)
    {
      Function function;
      for (unsigned int i = 0; i < 5; ++i)
        cursor.next_line();
      std::string text = cursor.next_line();
      text.resize(80, ' ');
      function.line = cursor.line_number();
      function.type = cursor.integer(text, 0, 5);
      function.response_entity = as_utf8(trimmed(text.substr(31, 10)));
      function.response_node = cursor.integer(text, 41, 10);
      function.response_direction = cursor.integer(text, 51, 4);
      function.reference_entity = as_utf8(trimmed(text.substr(56, 10)));
      function.reference_node = cursor.integer(text, 66, 10);
      function.reference_direction = cursor.integer(text, 76, 4);
      text = cursor.next_line();
      const int type = cursor.integer(text, 0, 10), n = cursor.integer(text, 10, 10);
      const bool even = function.even = cursor.integer(text, 20, 10) == 1;
      const double first = cursor.number(text, 30, 13), step = cursor.number(text, 43, 13);
      if ((type != 2 && type != 4 && type != 5 && type != 6) || n < 1)
        cursor.fail("gives the data type " + std::to_string(type) + " and " + std::to_string(n) +
                    " values: types are 2, 4 (real), 5, 6 (complex).");
      function.along = read_axis(cursor);
      function.numerator = read_axis(cursor);
      function.denominator = read_axis(cursor);
      cursor.next_line();

      const bool complex = type >= 5, twice = type == 4 || type == 6;
      const unsigned int per_value = (complex ? 2 : 1) + (even ? 0 : 1), size = twice ? 8 : 4;
      std::vector<double> numbers;
      if (binary.is)
      {
        std::vector<unsigned int> sizes(per_value, size);
        if (!even)
          sizes[0] = 4;
        numbers = read_binary(cursor, sizes, std::size_t(n) * per_value, binary);
      }
      else
      {
        std::vector<unsigned int> widths(6, 13);
        if (twice && even)
          widths = {20, 20, 20, 20};
        else if (twice)
          widths =
              complex ? std::vector<unsigned int>{13, 20, 20} : std::vector<unsigned int>{13, 20, 13, 20};
        numbers = read_ascii(cursor, widths, std::size_t(n) * per_value);
      }
      for (int l = 0; l < n; ++l)
      {
        const double *const at = numbers.data() + std::size_t(l) * per_value;
        function.abscissa.push_back(even ? first + l * step : at[0]);
        const double *const value = at + (even ? 0 : 1);
        function.values.emplace_back(value[0], complex ? value[1] : 0.);
      }
      // the end of the dataset
      while (trimmed(cursor.next_line()) != "-1")
        if (!binary.is)
          cursor.fail("has more values than the " + std::to_string(n) + " that it announces.");
      return function;
    }

    /// What files of measurements have besides (coherence 6, spectra 2, 3, 9, 12, ...) does not count.
    bool is_response(const Function &function)
    {
      return function.type == unknown_function ||
             function.type == (function.along.type == time_axis ? time_response : frequency_response);
    }

    /// @throws InputError if a function labels an axis with another unit than that of SI
    void check_units(const Cursor &cursor, const Function &function)
    {
      static const std::map<int, SiPowers> units = {
          {time_axis, {{0, 0, 1}}},      {frequency_axis, {{0, 0, -1}}}, {displacement, {{0, 1, 0}}},
          {velocity, {{0, 1, -1}}},      {acceleration, {{0, 1, -2}}},   {excitation_force, {{1, 1, -2}}},
          {reaction_force, {{1, 1, -2}}}};
      // beside the numerator some programs write the quotient: per N, or in time per N s
      std::vector<SiPowers> per_force = {{{0, 0, 0}}, units.at(excitation_force)};
      if (function.along.type == time_axis)
        per_force.push_back({{1, 1, -1}});
      const std::vector<SiPowers> alone = {{{0, 0, 0}}};
      const auto check = [&](const Axis &axis, const std::string &name, const int type,
                             const std::vector<SiPowers> &divisors)
      {
        const auto due = units.find(type);
        const std::string none[] = {"", "-", "none", "null"};
        if (due == units.end() ||
            std::find(std::begin(none), std::end(none), lower_case(axis.unit)) != std::end(none))
          return;
        const std::optional<SiPowers> found = si_powers(axis.unit);
        if (std::any_of(divisors.begin(), divisors.end(),
                        [&](const SiPowers &divisor)
                        {
                          SiPowers quotient = due->second;
                          for (unsigned int k = 0; k < 3; ++k)
                            quotient[k] -= divisor[k];
                          return found == quotient;
                        }))
          return;
        const std::string where = "ends a function of line " + std::to_string(function.line) + " whose " +
                                  name + " has the unit label '" + axis.unit + "'";
        const bool is_of_another =
            std::any_of(units.begin(), units.end(), [&](const auto &one) { return found == one.second; });
        if (axis.type == 0 && is_of_another)
          cursor.fail(where + ", but not the type of its quantity: give it (displacement 8, velocity 11, "
                              "acceleration 12, force 13).");
        cursor.fail(
            where +
            ", which is not that of its quantity in m, s, N, kg and Hz: convert the data to SI, or write "
            "NONE if they are.");
      };
      check(function.along, "abscissa", function.along.type, alone);
      // what the file does not say the quantity of is taken for displacement per force
      check(function.numerator, "numerator",
            function.numerator.type != 0 ? function.numerator.type : displacement, per_force);
      check(function.denominator, "denominator",
            function.denominator.type != 0 ? function.denominator.type : excitation_force, alone);
    }

    std::string direction_suffix(const Cursor &cursor, const int direction)
    {
      if (direction == 0)
        return "";
      if (std::abs(direction) > 3)
        cursor.fail("belongs to a function with rotations or moments (direction " +
                    std::to_string(direction) + "): contact knows displacements only, leave it out.");
      return std::string(direction < 0 ? "_-" : "_") + "xyz"[std::abs(direction) - 1];
    }

    /// Names of points: the entity, or the node; two nodes of one entity are told apart.
    class PointNames
    {
    public:
      std::string operator()(const std::string &entity, const int node)
      {
        const auto [at, is_new] = names.try_emplace({entity, node});
        if (is_new)
        {
          at->second = entity.empty() || entity == "NONE" ? std::to_string(node) : entity;
          if (is_taken(at->first, at->second))
            at->second += std::to_string(node);
          while (is_taken(at->first, at->second))
            at->second += "'";
        }
        return at->second;
      }

    private:
      using Key = std::pair<std::string, int>;
      bool is_taken(const Key &own, const std::string &text) const
      {
        return std::any_of(names.begin(), names.end(),
                           [&](const auto &one) { return one.first != own && one.second == text; });
      }

      std::map<Key, std::string> names;
    };

    unsigned int power_of(const Cursor &cursor, const Function &function)
    {
      const std::string where = "has a function of line " + std::to_string(function.line) + " ";
      if (function.denominator.type != excitation_force && function.denominator.type != reaction_force &&
          function.denominator.type != 0)
        cursor.fail(where + "per something else than a force (type " +
                    std::to_string(function.denominator.type) + "): give frequency responses to forces.");
      switch (function.numerator.type)
      {
      case displacement:
      case 0:
        return 0;
      case velocity:
        return 1;
      case acceleration:
        return 2;
      }
      cursor.fail(where + "of the kind " + std::to_string(function.numerator.type) +
                  ": displacement (8), velocity (11) or acceleration (12) is needed.");
    }
  } // namespace

  FrequencyData read_uff58(const std::string &file_name, const std::string &bytes)
  {
    Cursor cursor(file_name, bytes);
    FrequencyData data;
    data.file_name = file_name;
    PointNames names;
    int abscissa_type = 0;
    double rounding = 0;
    while (!cursor.at_end())
    {
      if (trimmed(cursor.next_line()) != "-1" || cursor.at_end())
        continue;
      const std::string header = cursor.next_line();
      const int dataset = cursor.integer(header, 0, 6);
      if (dataset == 164)
      {
        const std::string units = cursor.next_line();
        if (cursor.integer(units, 0, 10) != 1)
          cursor.fail("gives the units code " + std::to_string(cursor.integer(units, 0, 10)) +
                      ": convert the data to SI (code 1: m, N).");
      }
      if (dataset != 58)
      {
        while (!cursor.at_end() && trimmed(cursor.next_line()) != "-1")
          ;
        continue;
      }
      Binary binary;
      binary.is = header.size() > 6 && (header[6] == 'b' || header[6] == 'B');
      if (binary.is)
      {
        binary.big_endian = cursor.integer(header, 7, 6) == 2;
        if (cursor.integer(header, 13, 6) != 2)
          cursor.fail("announces binary numbers that are not IEEE 754: convert the file.");
        const int n_bytes = cursor.integer(header, 31, 12);
        if (n_bytes < 0)
          cursor.fail("gives its binary data a length of " + std::to_string(n_bytes) +
                      " bytes: the file is damaged.");
        binary.n_bytes = n_bytes;
      }
      const Function function = read_function(cursor, binary);
      if (!is_response(function))
      {
        ++data.n_skipped;
        continue;
      }
      if (function.along.type != time_axis && function.along.type != frequency_axis)
        cursor.fail("ends a function of the abscissa type " + std::to_string(function.along.type) +
                    ": frequency (18) or time (17) is needed.");
      check_units(cursor, function);
      if (data.entries.empty())
      {
        abscissa_type = function.along.type;
        data.frequency = function.abscissa;
        rounding = function.even ? 0 : rounding_of_times;
        check_axis(file_name, data.frequency, abscissa_type == time_axis ? "s" : "Hz", {});
      }
      if (function.along.type != abscissa_type || function.abscissa != data.frequency)
        cursor.fail(
            "ends a function whose axis differs from that of the first one: all entries need the same " +
            std::string(abscissa_type == time_axis ? "times." : "frequencies."));
      FrequencyData::Entry entry;
      entry.response = data.label_index(names(function.response_entity, function.response_node) +
                                        direction_suffix(cursor, function.response_direction));
      entry.reference = data.label_index(names(function.reference_entity, function.reference_node) +
                                         direction_suffix(cursor, function.reference_direction));
      entry.values = function.values;
      entry.derivative = power_of(cursor, function);
      data.entries.push_back(entry);
    }
    if (data.entries.empty())
      throw InputError("The universal file \"" + file_name +
                       "\" has no dataset 58 with a frequency response or an impulse response (" +
                       std::to_string(data.n_skipped) + " with other functions): these are needed.");
    if (abscissa_type == time_axis)
    {
      if (data.frequency.front() != 0)
        throw InputError("The universal file \"" + file_name +
                         "\" has impulse responses that do not begin at t = 0: cut them there.");
      transform_to_frequency(
          data, equal_time_step("The universal file \"" + file_name + "\"", data.frequency, rounding, {}));
    }
    return data;
  }
} // namespace vibrocontact
