#pragma once

#include <vibrocontact/contact/contact_operator.h>

#include <map>
#include <utility>

namespace vibrocontact
{
  class FourierProduct;

  /// A of normal forces on points in a line, evenly apart, of bodies that are alike everywhere along it (a ring on its
  /// road): A_ij = kernel(i - j), where kernel(-k) may differ from kernel(k).
  class EvenLineOperator : public ContactOperator
  {
  public:
    /// Null if the entries of a square matrix do not depend on the distance alone, to 1e-12 of the diagonal.
    static std::shared_ptr<const EvenLineOperator> of(const DenseMatrix &matrix);
    ~EvenLineOperator() override;
    unsigned int n_points() const override { return n; }
    unsigned int n_components() const override { return 1; }
    /// by FFT over a line that holds all points and those from the first source to the last
    void vmult(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &sources) const override;
    void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const override;
    double mean_diagonal(unsigned int) const override { return kernel[n - 1]; }
    bool fast_product() const override { return true; }
    /// From the eigenvalues of the line without ends, whose norm is not below that of any part of it.
    double jacobi_factor() const override { return factor; }

  private:
    explicit EvenLineOperator(std::vector<double> kernel);

    /// of target - source from -(n - 1) to n - 1
    const std::vector<double> kernel;
    const unsigned int n;
    const double factor;
    /// by first source and their number
    mutable std::map<std::pair<unsigned int, unsigned int>, std::unique_ptr<FourierProduct>> products;
  };
} // namespace vibrocontact
