#include <vibrocontact/contact/even_line_operator.h>
#include <vibrocontact/contact/fourier_product.h>

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace vibrocontact
{
  namespace
  {
    /// sources begin and end at multiples of so many points, so that a contact that moves a little keeps its transforms
    constexpr unsigned int coarseness = 32;
    /// transforms kept at once
    constexpr std::size_t most_products = 64;

    /// How far the eigenvalues of a line without ends, sum_k kernel(k) e^(-j k phi), are from its diagonal at most, over it.
    double largest_departure(const std::vector<double> &kernel)
    {
      // so many phases for each entry of the kernel that the sum is at most 2 % larger between two of them: 1 / cos(pi / 16)
      // (Ehlich & Zeller, Math. Z. 86 (1964) 41)
      std::vector<double> samples(padded(8 * kernel.size()), 0.);
      std::copy(kernel.begin(), kernel.end(), samples.begin());
      samples[kernel.size() / 2] = 0;
      std::vector<std::complex<double>> lines(samples.size() / 2 + 1);
      const fftw_plan plan = fftw_plan_dft_r2c_1d(
          samples.size(), samples.data(), reinterpret_cast<fftw_complex *>(lines.data()), FFTW_ESTIMATE);
      fftw_execute(plan);
      fftw_destroy_plan(plan);
      double largest = 0;
      for (const std::complex<double> &value : lines)
        largest = std::max(largest, std::abs(value));
      return largest / std::cos(M_PI / 16) / kernel[kernel.size() / 2];
    }
  } // namespace

  std::shared_ptr<const EvenLineOperator> EvenLineOperator::of(const DenseMatrix &matrix)
  {
    const int n = matrix.m();
    std::vector<double> kernel;
    for (int offset = 1 - n; offset < n; ++offset)
    {
      const int first = std::max(0, -offset), last = std::min(n, n - offset);
      double least = HUGE_VAL, largest = -HUGE_VAL;
      for (int source = first; source < last; ++source)
      {
        const double entry = matrix(source + offset, source);
        least = std::min(least, entry);
        largest = std::max(largest, entry);
      }
      if (!(largest - least <= 1e-12 * std::abs(matrix(0, 0))))
        return nullptr;
      kernel.push_back(0.5 * (least + largest));
    }
    return std::shared_ptr<const EvenLineOperator>(new EvenLineOperator(std::move(kernel)));
  }

  EvenLineOperator::EvenLineOperator(std::vector<double> own_kernel)
      : kernel(std::move(own_kernel)), n((kernel.size() + 1) / 2), factor(largest_departure(kernel))
  {
  }

  EvenLineOperator::~EvenLineOperator() = default;

  void EvenLineOperator::vmult(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &) const
  {
    y.reinit(n, true);
    const double *const force = R.data();
    unsigned int begin = 0, end = n;
    while (begin < end && force[begin] == 0)
      ++begin;
    while (end > begin && force[end - 1] == 0)
      --end;
    if (begin == end)
    {
      y = 0;
      return;
    }
    begin = begin / coarseness * coarseness;
    end = std::min(n, (end + coarseness - 1) / coarseness * coarseness);
    auto found = products.find({begin, end - begin});
    if (found == products.end())
    {
      if (products.size() == most_products)
        products.clear();
      auto product = std::make_unique<FourierProduct>(
          [this](unsigned int, unsigned int, const int offset, int) { return kernel[offset + n - 1]; }, 1,
          FourierProduct::Size{end - begin, 1}, FourierProduct::Size{n, 1}, -int(begin));
      found = products.emplace(std::pair(begin, end - begin), std::move(product)).first;
    }
    found->second->vmult(y.data(), force + begin, n, n);
  }

  void EvenLineOperator::extract(const std::vector<unsigned int> &points, DenseMatrix &block) const
  {
    block.reinit(points.size(), points.size());
    for (unsigned int j = 0; j < points.size(); ++j)
      for (unsigned int i = 0; i < points.size(); ++i)
        block(i, j) = kernel[points[i] + n - 1 - points[j]];
  }
} // namespace vibrocontact
