// The speed-accuracy chart as pictures: the contents of each panel.
#pragma once

#include "app/chart/chart_result.hpp"
#include "io/plots/log_figure.hpp"

namespace carom {

// The page for a paper: cost against the error of the paths for every scene, and the other errors where they show most.
LogFigure main_figure(const chart::ChartResult& result);

// Every scene (a row) with every error (a column).
LogFigure whole_figure(const chart::ChartResult& result);

// One scene of the user's own with every error.
LogFigure own_figure(const chart::ChartResult& result);

}  // namespace carom
