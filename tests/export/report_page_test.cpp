#include "export/report_page.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

TEST(HtmlText, EscapesWhatIsMarkup) {
  EXPECT_EQ(html_text("a < b & c > \"d\" 'e'"), "a &lt; b &amp; c &gt; &quot;d&quot; &#39;e&#39;");
}

TEST(ReportPage, PutsInWhatItIsGivenOnce) {
  const std::string html = report_page({"a<b", "{{data}}", "{{", "{}"});
  EXPECT_NE(html.find("<title>a&lt;b</title>"), std::string::npos);
  EXPECT_NE(html.find("\n{{data}}\n"), std::string::npos);
  EXPECT_NE(html.find("id=\"data\">{}</script>"), std::string::npos);
}

TEST(ReportPage, LoadsNothing) {
  const std::string html = report_page({});
  for (const char* const word : {"http:", "https:", "@import", "url(", " src="}) {
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace coordreq
