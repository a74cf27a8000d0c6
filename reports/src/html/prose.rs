//! The little Markdown that descriptions of cases use.

use crate::plots::escape;

/// Paragraphs, `` `code` `` and `*emphasis*` as HTML; all else is shown as it is written.
pub(super) fn html(text: &str) -> String {
    let paragraphs = text.split("\n\n").map(str::trim).filter(|p| !p.is_empty());
    paragraphs.map(|p| format!("<p>{}</p>", marked(&marked(&escape(p), '`', "code"), '*', "em"))).collect()
}

/// Text between pairs of a mark becomes an element. A mark without a partner, and one beside a space on its
/// inner side such as in `a * b`, stays as it is.
fn marked(text: &str, mark: char, tag: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(mark) {
        out.push_str(before);
        let tight = |inner: &str| !inner.is_empty() && inner.trim() == inner;
        match after.split_once(mark).filter(|(inner, _)| tight(inner)) {
            Some((inner, after)) => {
                out.push_str(&format!("<{tag}>{inner}</{tag}>"));
                rest = after;
            }
            None => {
                out.push(mark);
                rest = after;
            }
        }
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::html;

    #[test]
    fn marks_become_elements_and_everything_else_is_escaped() {
        assert_eq!(html("a *b* `<c>`\n\nd"), "<p>a <em>b</em> <code>&lt;c&gt;</code></p><p>d</p>");
        assert_eq!(html("2 * 3 * 4"), "<p>2 * 3 * 4</p>");
        assert_eq!(html("one * alone, `open"), "<p>one * alone, `open</p>");
    }
}
