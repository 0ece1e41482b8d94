#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/base/hdf5_file.h>

#include <complex>
#include <string>
#include <type_traits>
#include <vector>

namespace vibrocontact
{
  /// Both directions of a checkpoint: whoever has to survive an interruption lists its members once,
  ///
  ///     void MyRecorder::exchange(CheckpointFile &file)
  ///     {
  ///       file("my_recorder/next", next);
  ///     }
  ///
  /// and they are written, or read back bit for bit, whichever the file is open for.
  class CheckpointFile
  {
  public:
    explicit CheckpointFile(Hdf5Writer &writer) : writer(&writer) {}
    explicit CheckpointFile(Hdf5Reader &reader) : reader(&reader) {}

    bool reading() const { return reader != nullptr; }
    /// The same file, all names below this group: of two things with the same members.
    CheckpointFile group(const std::string &name) const
    {
      CheckpointFile result = *this;
      result.prefix += name + "/";
      return result;
    }

    void operator()(const std::string &name, std::vector<double> &values);
    void operator()(const std::string &name, DenseVector &values);
    void operator()(const std::string &name, std::string &text);
    /// as NAME/real and NAME/imaginary. A list that has a size keeps it. @throws ExcMessage if the file has another
    void operator()(const std::string &name, std::vector<std::complex<double>> &values);

    /// numbers, counts (below 2^53) and flags
    template <typename T>
    std::enable_if_t<std::is_arithmetic_v<T>> operator()(const std::string &name, T &value)
    {
      std::vector<double> one = {static_cast<double>(value)};
      (*this)(name, one);
      value = number_as<T>(one.at(0));
    }

    /// lists of small whole numbers and enumerations
    template <typename T>
    std::enable_if_t<!std::is_floating_point_v<T>> operator()(const std::string &name, std::vector<T> &values)
    {
      std::vector<int> numbers;
      for (const T &value : values)
        numbers.push_back(static_cast<int>(value));
      exchange(name, numbers);
      values.clear();
      for (const int number : numbers)
        values.push_back(static_cast<T>(number));
    }

  private:
    void exchange(const std::string &name, std::vector<int> &values);

    Hdf5Writer *writer = nullptr;
    Hdf5Reader *reader = nullptr;
    std::string prefix;
  };
} // namespace vibrocontact
