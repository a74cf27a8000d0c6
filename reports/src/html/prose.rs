//! The Markdown that descriptions of cases use, as HTML.

use pulldown_cmark::{Event, Parser, Tag, TagEnd, html::push_html};

/// Paragraphs, lists, code and emphasis as HTML; HTML in the text is shown as it is written.
pub(super) fn html(text: &str) -> String {
    rendered(Parser::new(text))
}

/// The page of a case without its heading, which the report has written already, and without the command to run
/// it again, which the report gives for the scene as it was run.
pub(super) fn page(text: &str) -> String {
    let body = text.lines().filter(|line| !line.starts_with("Run it again: "));
    let body: String = body.map(|line| format!("{line}\n")).collect();
    let mut inside = false;
    let parser = Parser::new(&body).filter(|event| {
        let is_heading = match event {
            Event::Start(Tag::Heading { level: pulldown_cmark::HeadingLevel::H1, .. }) => {
                inside = true;
                true
            }
            Event::End(TagEnd::Heading(pulldown_cmark::HeadingLevel::H1)) => {
                inside = false;
                true
            }
            _ => inside,
        };
        !is_heading
    });
    rendered(parser)
}

fn rendered<'a>(events: impl Iterator<Item = Event<'a>>) -> String {
    let plain = events.map(|event| match event {
        Event::Html(text) | Event::InlineHtml(text) => Event::Text(text),
        // The headings of a description stand below the heading of its case.
        Event::Start(Tag::Heading { .. }) => Event::Start(Tag::Heading {
            level: pulldown_cmark::HeadingLevel::H4,
            id: None,
            classes: Vec::new(),
            attrs: Vec::new(),
        }),
        Event::End(TagEnd::Heading(_)) => Event::End(TagEnd::Heading(pulldown_cmark::HeadingLevel::H4)),
        // A report loads nothing and leads nowhere else.
        Event::Start(Tag::Link { .. } | Tag::Image { .. }) => Event::Text("".into()),
        Event::End(TagEnd::Link | TagEnd::Image) => Event::Text("".into()),
        other => other,
    });
    let mut out = String::new();
    push_html(&mut out, plain);
    out
}

#[cfg(test)]
mod tests {
    use super::{html, page};

    #[test]
    fn marks_become_elements_and_everything_else_is_escaped() {
        assert_eq!(html("a *b* `<c>`\n\nd"), "<p>a <em>b</em> <code>&lt;c&gt;</code></p>\n<p>d</p>\n");
        assert_eq!(html("2 * 3 * 4"), "<p>2 * 3 * 4</p>\n");
        assert_eq!(html("a <b>c</b> [d](http://e)"), "<p>a &lt;b&gt;c&lt;/b&gt; d</p>\n");
    }

    #[test]
    fn the_page_of_a_case_loses_what_the_report_says_itself() {
        let text = "# Title\n\nBody.\n\n## Part\n\n```text\n/|\n```\n\nRun it again: `seam run x`\n";
        assert_eq!(
            page(text),
            "<p>Body.</p>\n<h4>Part</h4>\n<pre><code class=\"language-text\">/|\n</code></pre>\n"
        );
    }
}
