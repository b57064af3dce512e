#include "cli/study.hpp"

#include <ostream>

#include "cli/chart_drawing.hpp"

namespace taut {

int draw_chart(const std::vector<std::string>& results, const ChartRequest& request, const PlotFiles& files,
               Streams streams) {
  const Chart chart = make_chart(read_results(results), request);
  if (chart.without_result > 0)
    streams.err << "taut: " << chart.without_result << " runs have no result and are not on the chart\n";
  if (chart.cost == Cost::seconds && chart.machines.size() > 1)
    streams.err
        << "taut: the runs are of several machines or numbers of threads, so their seconds do not compare; "
           "--cost steps does\n";
  streams.out << orders_table(chart);
  const int code = draw_plot(files, chart_script(chart, files), chart_data(chart));
  streams.out << "\nchart  " << files.picture.string() << " (" << chart.measure << "), "
              << files.script().filename().string() << ", " << files.data().filename().string() << '\n';
  return code;
}

}  // namespace taut
