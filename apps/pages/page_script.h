// What runs in the browser on a page: the modules of apps/pages/web with the npm packages that they
// use (apps/pages/package.json), bundled at build time.
#pragma once

#include <string_view>

namespace scattermeter::apps {

extern const std::string_view kPageScript;        // ASCII, may stand between <script> and </script>
extern const std::string_view kPageScriptSha256;  // in base64, for the Content-Security-Policy

}  // namespace scattermeter::apps
