#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/receptances/sampled_response.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>
#include <fftw3.h>
#include <map>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    double largest(const FrequencyData::Entry &entry)
    {
      double value = 0;
      for (const Complex &one : entry.values)
        value = std::max(value, std::abs(one));
      return value;
    }

    /// What is cut off stands in no line: they would be those of another body.
    void check_decay(const FrequencyData &data, const double step)
    {
      constexpr double most_left = 0.05, least_entry = 1e-3;
      std::vector<double> sizes;
      std::map<unsigned int, double> largest_of_derivative;
      for (const FrequencyData::Entry &entry : data.entries)
      {
        sizes.push_back(largest(entry));
        double &all = largest_of_derivative[entry.derivative];
        all = std::max(all, sizes.back());
      }
      for (unsigned int k = 0; k < data.entries.size(); ++k)
      {
        const FrequencyData::Entry &entry = data.entries[k];
        const std::size_t n = entry.values.size(), n_last = std::max<std::size_t>(1, n / 10);
        double square = 0;
        for (std::size_t i = n - n_last; i < n; ++i)
          square += std::norm(entry.values[i]);
        const double left = std::sqrt(square / n_last);
        if (sizes[k] >= least_entry * largest_of_derivative[entry.derivative] && left > most_left * sizes[k])
          throw InputError("The data \"" + data.file_name + "\" end at " + number_text((n - 1) * step) +
                           " s, before the impulse response " + entry_name(data, k) +
                           " has decayed: its last tenth has an rms of " + percent_text(left / sizes[k]) +
                           " of its largest value. Give a longer one, down to " + percent_text(most_left) +
                           ".");
      }
    }

    /// of the polynomial through the first samples; its differences to those of the two degrees below estimate what it leaves
    constexpr unsigned int degree_of_beginning = 6;
    /// of the images, where the polynomial is taken for the beginning
    constexpr double most_left_by_polynomial = 0.05;

    /// Terms of sum_{m != 0} 1 / (y - pi m) = -2 sum_n zeta(2n) y^(2n - 1) / pi^(2n), enough for |y| <= pi / 2.
    constexpr unsigned int n_terms = 40;

    /// Trapezoids of a step h add to the transform of t^k from t = 0 on, over h^(k + 1), (-j / 2) (j / 2)^k d^k/dy^k (cot y - 1 / y) at
    /// y = omega h / 2: the images of k! / s^(k + 1) at multiples of the sampling rate.
    /// @param n samples @return by power, for the lines up to half the sampling rate
    std::vector<std::vector<Complex>> images_of_powers(const unsigned int n)
    {
      std::vector<std::vector<Complex>> images(degree_of_beginning + 1, std::vector<Complex>(n / 2 + 1));
      // coefficients of the k-th derivative, by powers of y
      std::vector<double> terms(2 * n_terms, 0.);
      for (unsigned int m = 1; m <= n_terms; ++m)
        terms[2 * m - 1] = -2 * std::riemann_zeta(2. * m) * std::pow(M_PI, -2. * m);
      dealii::Polynomials::Polynomial<double> derivative(terms);
      Complex factor(0, -0.5);
      for (std::vector<Complex> &image : images)
      {
        for (unsigned int l = 0; l < image.size(); ++l)
          image[l] = factor * derivative.value(M_PI * l / n);
        derivative = derivative.derivative();
        factor *= Complex(0, 0.5);
      }
      return images;
    }

    /// Coefficients by powers of t / h of the polynomial through the first samples.
    std::vector<double> beginning(const FrequencyData::Entry &entry, const unsigned int degree)
    {
      std::vector<dealii::Point<1>> places;
      for (unsigned int i = 0; i <= degree; ++i)
        places.emplace_back(double(i));
      const auto basis = dealii::Polynomials::generate_complete_Lagrange_basis(places);
      std::vector<double> coefficients(degree + 1, 0.), derivatives(degree + 1);
      for (unsigned int i = 0; i <= degree; ++i)
      {
        basis[i].value(0., derivatives);
        double factorial = 1;
        for (unsigned int k = 0; k <= degree; factorial *= ++k)
          coefficients[k] += entry.values[i].real() * derivatives[k] / factorial;
      }
      return coefficients;
    }

    /// The images of an entry's beginning, per line: first by the whole degree, then by the one or two below.
    std::vector<std::vector<Complex>> images_of_beginning(const FrequencyData::Entry &entry,
                                                          const double step,
                                                          const std::vector<std::vector<Complex>> &images)
    {
      const unsigned int degree = std::min<std::size_t>(degree_of_beginning, entry.values.size() - 1);
      std::vector<std::vector<Complex>> result;
      for (unsigned int lower = 0; lower <= std::min(2u, degree); ++lower)
      {
        const std::vector<double> powers = beginning(entry, degree - lower);
        std::vector<Complex> sum(images.front().size());
        for (unsigned int k = 0; k < powers.size(); ++k)
          for (unsigned int l = 0; l < sum.size(); ++l)
            sum[l] += step * powers[k] * images[k][l];
        result.push_back(sum);
      }
      return result;
    }

    /// Whether the degrees of images_of_beginning() agree. They do not where a response was filtered, begins later or between two samples,
    /// or is sampled too rarely.
    bool converges(const std::vector<std::vector<Complex>> &by_degree)
    {
      double left = 0, size = 0;
      for (std::size_t l = 0; l < by_degree.front().size(); ++l)
      {
        double differences = 0;
        for (std::size_t lower = 1; lower < by_degree.size(); ++lower)
          differences += std::abs(by_degree[lower][l] - by_degree[lower - 1][l]);
        left += differences * differences;
        size += std::norm(by_degree.front()[l]);
      }
      return left < most_left_by_polynomial * most_left_by_polynomial * size;
    }
  } // namespace

  void transform_to_frequency(FrequencyData &data, const double step)
  {
    for (const FrequencyData::Entry &entry : data.entries)
      if (entry.derivative >= 2)
        throw InputError("The data \"" + data.file_name +
                         "\" give the acceleration after a blow at t = 0, but not the blow itself, where "
                         "the velocity jumps by 1 / mass per N s: give velocities, displacements or "
                         "frequency responses.");
    check_decay(data, step);
    const int n = data.entries.front().values.size();
    std::vector<double> samples(n);
    std::vector<Complex> lines(n / 2 + 1);
    const fftw_plan plan = fftw_plan_dft_r2c_1d(
        n, samples.data(), reinterpret_cast<fftw_complex *>(lines.data()), FFTW_ESTIMATE);
    data.frequency.clear();
    for (unsigned int l = 0; l < lines.size(); ++l)
      data.frequency.push_back(l / (n * step));
    const std::vector<std::vector<Complex>> images = images_of_powers(n);
    for (FrequencyData::Entry &entry : data.entries)
    {
      for (int i = 0; i < n; ++i)
        samples[i] = step * (i == 0 ? 0.5 : 1.) * entry.values[i].real();
      fftw_execute(plan);
      const std::vector<std::vector<Complex>> by_degree = images_of_beginning(entry, step, images);
      entry.values = lines;
      if (!converges(by_degree))
      {
        ++data.n_without_blow;
        continue;
      }
      for (std::size_t l = 0; l < lines.size(); ++l)
        entry.values[l] -= by_degree.front()[l];
    }
    fftw_destroy_plan(plan);
  }
} // namespace vibrocontact
