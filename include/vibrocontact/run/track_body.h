#pragma once

#include <vibrocontact/base/table.h>
#include <vibrocontact/bodies/receptance_fit.h>
#include <vibrocontact/bodies/reduced_body.h>
#include <vibrocontact/numerics/local_polynomials.h>
#include <vibrocontact/reduction/reduction_cache.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/waveguide/track_in_contact.h>

#include <nlohmann/json.hpp>

#include <complex>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A periodic rail of a scene in its contact, made when first asked for or found in the cache. Collective are at_rest(),
  /// moving() and in_time(), all else once moving() has returned is not.
  class TrackBody
  {
  public:
    /// @param grid of its contact @param key everything that determines it, as text
    TrackBody(const BodyParameters &body, const ContactGrid &grid, const std::string &key,
              const std::string &cache_directory, MPI_Comm communicator);

    /// At rest: its elastic compliance alone, no poles.
    ReducedBody at_rest();
    /// Moving: poles near its receptance.
    ReducedBody moving();

    /// Moving in time: passive poles near its receptance, in these bands above all. Collective.
    /// @throws InputError if no poles near it are passive
    ReducedBody in_time(const std::vector<FrequencyBand> &bands);

    /// What is wrong with the rail's section or the patch on it. @throws InputError
    void check() const;
    /// up to which its poles follow [Hz]
    double highest_frequency() const { return rail().fitted_up_to; }
    /// R(s) of the six motions of its patch, exactly, at any s with Im s > 0 and Re s not far below 0; for as long as this body
    /// lives [m/N].
    std::function<ComplexMatrix(const std::complex<double> &)> receptance();
    /// The same by local polynomials, for as long as this body lives.
    LocalPolynomials &nearby();
    /// What of R is in the rest of moving(), beside its poles; and of at_rest(). [m/N]
    const DenseMatrix &beside_poles() { return fit().body.residual; }
    const DenseMatrix &elastic() { return reduction(false).at_rest; }
    /// The poles' part of R.
    std::function<ComplexMatrix(const std::complex<double> &)> by_poles();
    /// 3 n x 6
    const DenseMatrix &motions() { return reduction(false).motions; }

    /// Its receptance beside what poles make of it, a row per frequency, by the names of the tables; empty if nothing has asked
    /// for poles.
    std::map<std::string, Table> fit_tables() const;
    /// Pairs and errors, of the poles in time as well; null if nothing has asked for poles.
    nlohmann::ordered_json fit_json() const;

    const std::string &key() const { return own_key; }
    const ContactGrid &contact_grid() const { return grid; }
    /// frequencies that its poles follow
    static constexpr unsigned int n_frequencies = 96;

    const BodyParameters &parameters;

  private:
    const RailParameters &rail() const { return *parameters.description->periodic_rail(); }
    const TrackInContact &track();
    /// at rest; with_lines: with receptances over frequency
    const TrackReduction &reduction(bool with_lines);
    const ReceptanceFit &fit();
    ReducedBody by(const ReceptanceFit &poles);
    void solve_all_frequencies(TrackReduction &into);
    /// R at these frequencies.
    DirectResponse solved(const std::vector<double> &frequency);
    /// The same, which the next fit of poles in time asks for again, in this run or the next one.
    const DirectResponse &lines_in_bands(const std::vector<double> &frequency);

    const ContactGrid grid;
    const std::string own_key;
    const ReductionCache cache;
    const MPI_Comm communicator;
    std::unique_ptr<const TrackInContact> made;
    std::unique_ptr<LocalPolynomials> local;
    std::optional<TrackReduction> reduced;
    std::optional<ReceptanceFit> fitted;
    std::optional<DirectResponse> in_bands;

    /// Poles in time, the lines that they follow and what they follow closely.
    struct InTime
    {
      std::vector<FrequencyBand> bands;
      TrackReduction lines;
      ReceptanceFit fit;

      double worst_error_in_bands() const;
    };
    std::optional<InTime> timed;
  };
} // namespace vibrocontact
