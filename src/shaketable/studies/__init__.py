"""Published studies done again with the motions at hand: a room per paper, a table per result."""

from shaketable.studies.registry import STUDIES
from shaketable.studies.study import Claim, Option, PublishedStudy, Study, StudyInput

__all__ = ["STUDIES", "Claim", "Option", "PublishedStudy", "Study", "StudyInput"]
