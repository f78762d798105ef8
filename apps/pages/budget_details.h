// The causes of an estimate's uncertainty, on a page.
#pragma once

#include "apps/pages/html_page.h"
#include "core/fit/estimate.h"

namespace scattermeter::apps {

// To be said once above the details.
inline constexpr const char* kBudgetLegend =
    "One standard deviation for each cause, and its share of the variance. Shares of correlated "
    "causes need not add up to one.";

// Folded: a sentence naming the largest cause of each coefficient, then all of them, the largest
// share first. Empty without a budget.
Html budget_details(char channel, const Estimate& estimate);

}  // namespace scattermeter::apps
