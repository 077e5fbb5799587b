"""Sees everything in a page that must not happen: errors, broken content policy, calls to other hosts."""

from __future__ import annotations

from urllib.parse import urlsplit

from playwright.sync_api import BrowserContext, ConsoleMessage, Page, Request

VIOLATIONS = """
window.policyViolations = [];
document.addEventListener("securitypolicyviolation", (event) => {
  policyViolations.push(event.violatedDirective + " " + event.blockedURI);
});
"""
LOCAL_SCHEMES = frozenset({"data", "blob", "about"})


class Witness:
    """Listens to one page from its first request on."""

    def __init__(self, context: BrowserContext, page: Page, origin: str) -> None:
        self._page = page
        self._origin = urlsplit(origin).netloc
        self.errors: list[str] = []
        self.foreign: list[str] = []
        context.add_init_script(VIOLATIONS)
        context.on("request", self._on_request)
        page.on("console", self._on_console)
        page.on("pageerror", lambda error: self.errors.append(str(error)))

    def violations(self) -> list[str]:
        """Of the content security policy, in the page that is open now and in the frames within it."""
        return [told for frame in self._page.frames for told in frame.evaluate("window.policyViolations ?? []")]

    def assert_nothing_happened(self) -> None:
        """Call it before leaving a page and at the end."""
        found = {"errors": self.errors, "other hosts": self.foreign, "policy": self.violations()}
        assert not any(found.values()), found

    def _on_request(self, request: Request) -> None:
        url = urlsplit(request.url)
        if url.scheme not in LOCAL_SCHEMES and url.netloc != self._origin:
            self.foreign.append(request.url)

    def _on_console(self, message: ConsoleMessage) -> None:
        if message.type == "error":
            self.errors.append(f"{message.text} ({message.location.get('url', '')})")
