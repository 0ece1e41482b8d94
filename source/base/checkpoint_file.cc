#include <vibrocontact/base/checkpoint_file.h>

#include <algorithm>

namespace vibrocontact
{
  void CheckpointFile::operator()(const std::string &name, std::vector<double> &values)
  {
    if (writer)
      writer->write(prefix + name, values);
    else
      values = reader->numbers(prefix + name);
  }

  void CheckpointFile::operator()(const std::string &name, DenseVector &values)
  {
    std::vector<double> numbers(values.begin(), values.end());
    (*this)(name, numbers);
    values.reinit(numbers.size());
    std::copy(numbers.begin(), numbers.end(), values.begin());
  }

  void CheckpointFile::operator()(const std::string &name, std::string &text)
  {
    if (writer)
      writer->write(prefix + name, text);
    else
      text = reader->text(prefix + name);
  }

  void CheckpointFile::operator()(const std::string &name, std::vector<std::complex<double>> &values)
  {
    std::vector<double> real, imaginary;
    for (const std::complex<double> &value : values)
    {
      real.push_back(value.real());
      imaginary.push_back(value.imag());
    }
    (*this)(name + "/real", real);
    (*this)(name + "/imaginary", imaginary);
    AssertThrow(real.size() == imaginary.size() && (values.empty() || values.size() == real.size()),
                dealii::ExcMessage("The checkpoint's lists " + prefix + name + " are damaged."));
    values.resize(real.size());
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = {real[k], imaginary[k]};
  }

  void CheckpointFile::exchange(const std::string &name, std::vector<int> &values)
  {
    if (writer)
      writer->write(prefix + name, values);
    else
      values = reader->integers(prefix + name);
  }
} // namespace vibrocontact
