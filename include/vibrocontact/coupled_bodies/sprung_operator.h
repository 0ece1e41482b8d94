#pragma once

#include <vibrocontact/contact/contact_operator.h>

#include <vector>

namespace vibrocontact
{
  /// A of bodies the first of which hangs on springs: the contact forces also move it as a whole,
  ///
  ///   y = A R + sum of c h (h . R),
  ///
  /// h: rows of y per motion along an axis, c: compliance of the spring along it. The far end of a spring is moved until it
  /// carries a given force (LoadedContact), which any c > 0 serves.
  class SprungOperator : public ContactOperator
  {
  public:
    struct Spring
    {
      /// h [-]; rows of y
      DenseVector motion;
      /// c [m/N]
      double compliance;
    };

    SprungOperator(std::shared_ptr<const ContactOperator> held, std::vector<Spring> springs);
    unsigned int n_points() const override { return held->n_points(); }
    unsigned int n_components() const override { return held->n_components(); }
    void vmult(DenseVector &y, const DenseVector &R, const std::vector<unsigned int> &sources) const override;
    void vmult_among(DenseVector &y, const DenseVector &R,
                     const std::vector<unsigned int> &sources) const override;
    void extract(const std::vector<unsigned int> &points, DenseMatrix &block) const override;
    /// Diagonals are those of the held bodies: projections go by what a point alone gives way, not by the springs.
    double mean_diagonal(const unsigned int component) const override
    {
      return held->mean_diagonal(component);
    }
    double diagonal(const unsigned int component, const unsigned int point) const override
    {
      return held->diagonal(component, point);
    }
    bool fast_product() const override { return held->fast_product(); }

  private:
    /// c (h . R) of a spring [m]
    double stretch(const Spring &spring, const DenseVector &R,
                   const std::vector<unsigned int> &sources) const;

    std::shared_ptr<const ContactOperator> held;
    std::vector<Spring> springs;
  };
} // namespace vibrocontact
